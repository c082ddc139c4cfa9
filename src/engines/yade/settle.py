import csv
import os
import sys
from math import atan, pi, sqrt
from yade import utils


def rows(name):
    with open(name) as file:
        return list(csv.DictReader(file))


def numbers(row, names):
    return [float(row[name]) for name in names.split()]


def material(density):
    return O.materials.append(FrictMat(
        young=young, poisson=poisson, frictionAngle=atan(friction), density=density))


kinds = {row["kind"]: numbers(row, "mass ixx iyy izz") for row in rows("kinds.csv")}
spheres = {name: [] for name in kinds}
for row in rows("spheres.csv"):
    spheres[row["kind"]].append(numbers(row, "x y z r"))

# Spheres that touch weigh next to nothing; six that touch nothing carry mass and inertia.
light = material(light_share * density)
carriers = {}
for name, (mass, *moments) in kinds.items():
    size = 0.01 * sqrt(min(moments) / mass)
    own = material(mass / 6 / (4 / 3 * pi * size**3))
    sum_of_squares = 1.5 / mass * sum(moments) - 1.8 * size**2
    arms = [sqrt(sum_of_squares - 3 / mass * i + 1.2 * size**2) for i in moments]
    carriers[name] = (own, size, arms)

walls = material(density)
O.bodies.append([utils.wall(at, axis, material=walls)
                 for at, axis in ((0, 0), (floor[0], 0), (0, 1), (floor[1], 1), (0, 2))])
clumps = []
for row in rows("grains.csv"):
    name = row["kind"]
    centre = Vector3(*numbers(row, "x y z"))
    turn = Quaternion(*numbers(row, "qw qx qy qz"))
    members = [utils.sphere(centre + turn * Vector3(x, y, z), r, material=light) for x, y, z, r in spheres[name]]
    own, size, arms = carriers[name]
    for axis in range(3):
        for sign in (1, -1):
            arm = Vector3(0, 0, 0)
            arm[axis] = sign * arms[axis]
            members.append(utils.sphere(centre + turn * arm, size, material=own, mask=0))
    clump, ids = O.bodies.appendClumped(members, discretization=0)
    clumps.append(clump)
    # What damping at contacts takes for the mass.
    for body in ids:
        O.bodies[body].state.mass = kinds[name][0]

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=skin),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_FrictMat_FrictMat_MindlinPhys(en=restitution, es=restitution)],
        [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(damping=0, gravity=(0, 0, -gravity), exactAsphericalRot=True),
]
O.dt = step


def energy():
    total = 0
    for clump in clumps:
        state = O.bodies[clump].state
        spin = state.ori.conjugate() * state.angVel
        total += 0.5 * state.mass * state.vel.squaredNorm()
        total += 0.5 * sum(state.inertia[i] * spin[i]**2 for i in range(3))
    return total


first = O.bodies[clumps[0]].state
print("first grain: mass %.9e kg, centre %.9e %.9e %.9e m, moments %.9e %.9e %.9e kg m2" % (
    first.mass, *first.pos, *sorted(first.inertia)))
O.run(falling, True)
while energy() >= rest and O.iter < most:
    O.run(500, True)
lost = sum(1 for clump in clumps if not (0 < O.bodies[clump].state.pos[2]
           and all(0 < O.bodies[clump].state.pos[axis] < floor[axis] for axis in (0, 1))))
print("%s: kinetic energy %e J, %d grains, %d lost, %d steps" % (
    "at rest" if energy() < rest else "not at rest", energy(), len(clumps), lost, O.iter))
with open("settled.csv", "w") as file:
    file.write("x,y,z,r\n")
    for body in O.bodies:
        if isinstance(body.shape, Sphere) and body.mask:
            file.write("%.9e,%.9e,%.9e,%.9e\n" % (*body.state.pos, body.shape.radius))
sys.stdout.flush()
os._exit(0)
