// A dam of 20 m with a core and a blanket drain, in m. berm reads the physical groups: surfaces are
// named after soils, curves after what [[seepage.boundary]] asks for.
Point(1) = {0, 0, 0};
Point(2) = {44, 0, 0};
Point(3) = {56, 0, 0};
Point(4) = {80, 0, 0};
Point(5) = {100, 0, 0};
Point(6) = {53, 20, 0};
Point(7) = {52, 20, 0};
Point(8) = {48, 20, 0};
Point(9) = {47, 20, 0};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 9};
Line(9) = {9, 1};
Line(10) = {2, 8};
Line(11) = {3, 7};

Curve Loop(1) = {1, 10, 8, 9};
Curve Loop(2) = {2, 11, 7, -10};
Curve Loop(3) = {3, 4, 5, 6, -11};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};

Physical Surface("shell") = {1, 3};
Physical Surface("core") = {2};
Physical Curve("blanket") = {4};
