# UFL forms of the flow problem
