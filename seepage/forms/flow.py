# Steady unconfined Darcy flow: residual, its derivative, and the flux of each element.
# Equation numbers are those of docs/theory.md, section 2.
from ufl import (
    CellVolume,
    Coefficient,
    FiniteElement,
    TestFunction,
    TrialFunction,
    VectorElement,
    as_matrix,
    as_vector,
    derivative,
    dx,
    exp,
    grad,
    inner,
    min_value,
    triangle,
)

linear = FiniteElement("Lagrange", triangle, 1)
constant = FiniteElement("DG", triangle, 0)
constant_vector = VectorElement("DG", triangle, 0)
constant_tensor = VectorElement("DG", triangle, 0, dim=3)

p = Coefficient(linear)  # pressure head [m]
w = Coefficient(linear)  # 1 inside, 0 on what may become a seepage face [-]
eps = Coefficient(constant)  # smoothing of the relative conductivity [m]
k_sat = Coefficient(constant_tensor)  # k_xx, k_xy, k_yy [m/s]
k_min = Coefficient(constant)  # relative conductivity far above the free surface [-]

v = TestFunction(linear)
dp = TrialFunction(linear)
t = TestFunction(constant_vector)

# Eq. (2.5): relative conductivity.
k_r = k_min + (1 - k_min) * exp(min_value((p - eps * w) / eps, 0))

# Eq. (2.2): Darcy flux with h = p + y.
K = as_matrix(((k_sat[0], k_sat[1]), (k_sat[1], k_sat[2])))
q = -k_r * K * (grad(p) + as_vector((0, 1)))

# Eq. (2.6): residual; its value at a node is the water that has to enter there.
residual = -inner(q, grad(v)) * dx(degree=3)
jacobian = derivative(residual, p, dp)
# Mean flux of an element.
flux = inner(q, t) / CellVolume(triangle) * dx(degree=3)

forms = [residual, jacobian, flux]
