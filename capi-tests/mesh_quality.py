"""The worst tetrahedra of a mesh in TetGen's format: smallest dihedral angle in degrees, largest ratio of circumradius to shortest edge."""
import math


def rows(path):
    """The numbers of each line but the first and comments."""
    lines = (line.split("#")[0].split() for line in open(path))
    return [fields for fields in lines if fields][1:]


def worst(base):
    """(smallest dihedral angle, largest radius-edge ratio) of BASE.node and BASE.ele; a flat tetrahedron has angle 0."""
    points = {int(row[0]): tuple(float(x) for x in row[1:4]) for row in rows(base + ".node")}
    angle, ratio = 180.0, 0.0
    for row in rows(base + ".ele"):
        of_tet = of(*(points[int(v)] for v in row[1:5]))
        angle, ratio = min(angle, of_tet[0]), max(ratio, of_tet[1])
    return angle, ratio


def of(a, b, c, d):
    """The same of one tetrahedron."""
    u, v, w = sub(b, a), sub(c, a), sub(d, a)
    normals = [cross(sub(d, b), sub(c, b)), cross(v, w), cross(w, u), cross(u, v)]
    lengths = [math.sqrt(dot(n, n)) for n in normals]
    edges = [dot(e, e) for e in (u, v, w, sub(c, b), sub(d, b), sub(d, c))]
    volume = dot(u, normals[1])
    if 0.0 in lengths or volume == 0.0:
        return 0.0, math.inf
    cosine = max(-dot(normals[i], normals[j]) / (lengths[i] * lengths[j]) for i in range(4) for j in range(i))
    to_centre = [edges[0] * x + edges[1] * y + edges[2] * z for x, y, z in zip(*normals[1:])]
    radius = math.sqrt(dot(to_centre, to_centre)) / abs(2.0 * volume)
    return math.degrees(math.acos(min(1.0, cosine))), radius / math.sqrt(min(edges))


def sub(p, q):
    return p[0] - q[0], p[1] - q[1], p[2] - q[2]


def dot(p, q):
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


def cross(p, q):
    return p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]
