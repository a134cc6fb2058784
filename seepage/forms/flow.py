# Steady unconfined Darcy flow: residual, its derivative, and the flux of each element.
# Equation numbers are those of docs/theory.md, section 2.
from ufl import (
    CellVolume,
    Coefficient,
    TestFunction,
    TrialFunction,
    as_matrix,
    as_vector,
    conditional,
    derivative,
    dx,
    exp,
    grad,
    gt,
    inner,
    max_value,
    min_value,
    triangle,
)

try:  # DOLFINX 0.9
    from basix.ufl import element
    from ufl import FunctionSpace, Mesh

    domain = Mesh(element("Lagrange", "triangle", 1, shape=(2,)))

    def space(family, degree, *shape):
        return FunctionSpace(domain, element(family, "triangle", degree, shape=shape))

except ImportError:  # 0.5
    from ufl import FiniteElement, VectorElement

    domain = triangle

    def space(family, degree, *shape):
        scalar = FiniteElement(family, domain, degree)
        return VectorElement(scalar, dim=shape[0]) if shape else scalar


linear = space("Lagrange", 1)
constant = space("DG", 0)
constant_vector = space("DG", 0, 2)
constant_tensor = space("DG", 0, 3)
constant_curve = space("DG", 0, 4)

p = Coefficient(linear)  # pressure head [m]
w = Coefficient(linear)  # 1 inside, 0 on what may become a seepage face [-]
eps = Coefficient(constant)  # length over which the relative conductivity falls [m]
shift = Coefficient(constant)  # pressure head below which it falls, for w = 1 [m]
k_sat = Coefficient(constant_tensor)  # k_xx, k_xy, k_yy [m/s]
k_min = Coefficient(constant)  # relative conductivity far above the free surface [-]
curve = Coefficient(constant_curve)  # van Genuchten's n, l, air entry, scale [-]

v = TestFunction(linear)
dp = TrialFunction(linear)
t = TestFunction(constant_vector)

# Eq. (2.40): relative conductivity, exponential in all soils, or van Genuchten's in those with a
# scale. Powers of the suction neither vanish nor overflow between its bounds.
u = (p - shift * w) / eps
exponential = exp(min_value(u, 0))
n, l, entry, scale = curve[0], curve[1], curve[2], curve[3]
m = 1 - 1 / n
y = min_value(max_value(-u, entry), 1e5) ** n
mualem = scale * (1 + y) ** (-m * l) * (1 - (y / (1 + y)) ** m) ** 2
mixed = conditional(gt(scale, 0), mualem, exponential)


def forms_of(f):
    """Residual, its derivative, and the mean flux of each element, for the law f(u)."""
    # Eq. (2.2): Darcy flux with h = p + y.
    k_r = k_min + (1 - k_min) * f
    K = as_matrix(((k_sat[0], k_sat[1]), (k_sat[1], k_sat[2])))
    q = -k_r * K * (grad(p) + as_vector((0, 1)))
    # Eq. (2.6): residual; its value at a node is the water that has to enter there.
    residual = -inner(q, grad(v)) * dx(degree=3)
    flux = inner(q, t) / CellVolume(domain) * dx(degree=3)
    return residual, derivative(residual, p, dp), flux


residual, jacobian, flux = forms_of(exponential)
# Powers are dear: only for sections with a soil that has the curve.
curve_residual, curve_jacobian, curve_flux = forms_of(mixed)

forms = [residual, jacobian, flux, curve_residual, curve_jacobian, curve_flux]
