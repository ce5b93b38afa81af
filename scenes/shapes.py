"""Meshes for the scenes: positions, triangles counter-clockwise seen from outside, normals."""

import math


def grid_triangles(rows, columns, wrap_rows):
    """Triangles of a grid of vertices that closes on itself in columns, and in rows if asked."""
    index = lambda i, j: (i % rows) * columns + j % columns
    triangles = []
    for i in range(rows if wrap_rows else rows - 1):
        for j in range(columns):
            a, b, c, d = index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)
            triangles += [(a, b, c), (a, c, d)]
    return triangles


def sphere(radius, rings=48, sectors=96):
    """A closed sphere about the origin: positions, triangles, normals."""
    normals = []
    for i in range(1, rings):
        theta = math.pi * i / rings
        for j in range(sectors):
            phi = -2 * math.pi * j / sectors
            normals.append((math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi)))
    triangles = grid_triangles(rings - 1, sectors, wrap_rows=False)
    top, bottom, last = len(normals), len(normals) + 1, (rings - 2) * sectors
    normals += [(0, 1, 0), (0, -1, 0)]
    for j in range(sectors):
        k = (j + 1) % sectors
        triangles += [(top, j, k), (bottom, last + k, last + j)]
    # Corners stand a little outside, so that the faceted solid has the sphere's volume.
    scale = radius * (1 + (math.pi / rings) ** 2 / 6)
    return [tuple(scale * x for x in n) for n in normals], orient(normals, triangles), normals


def torus(major, minor, rings=96, sectors=48):
    """A closed torus about the y axis."""
    positions, normals = [], []
    for i in range(rings):
        u = 2 * math.pi * i / rings
        for j in range(sectors):
            v = 2 * math.pi * j / sectors
            normal = (math.cos(u) * math.cos(v), math.sin(v), math.sin(u) * math.cos(v))
            normals.append(normal)
            positions.append((major * math.cos(u) + minor * normal[0], minor * normal[1], major * math.sin(u) + minor * normal[2]))
    return positions, orient_by_normals(positions, normals, grid_triangles(rings, sectors, wrap_rows=True)), normals


def rod(a, b, radius, sectors=12):
    """A cylinder without caps from a to b."""
    axis = tuple(q - p for p, q in zip(a, b))
    length = math.hypot(*axis)
    w = tuple(x / length for x in axis)
    side = (1, 0, 0) if abs(w[0]) < 0.5 else (0, 1, 0)
    u = (w[1] * side[2] - w[2] * side[1], w[2] * side[0] - w[0] * side[2], w[0] * side[1] - w[1] * side[0])
    norm = math.hypot(*u)
    u = tuple(x / norm for x in u)
    v = (w[1] * u[2] - w[2] * u[1], w[2] * u[0] - w[0] * u[2], w[0] * u[1] - w[1] * u[0])
    positions, normals = [], []
    for end in (a, b):
        for j in range(sectors):
            c, s = math.cos(2 * math.pi * j / sectors), math.sin(2 * math.pi * j / sectors)
            normal = tuple(c * p + s * q for p, q in zip(u, v))
            normals.append(normal)
            positions.append(tuple(e + radius * n for e, n in zip(end, normal)))
    return positions, orient_by_normals(positions, normals, grid_triangles(2, sectors, wrap_rows=False)), normals


def lathe(profile, sectors=64):
    """The surface swept by a profile of (radius, height, normal's radius, normal's height) about the y axis; no caps.
    Where the radius is 0 a profile begins or ends in a point."""
    positions, normals = [], []
    for radius, height, across, up in profile:
        for j in range(sectors):
            c, s = math.cos(2 * math.pi * j / sectors), math.sin(2 * math.pi * j / sectors)
            positions.append((radius * c, height, radius * s))
            normals.append((across * c, up, across * s))
    triangles = [t for t in grid_triangles(len(profile), sectors, wrap_rows=False) if len({positions[i] for i in t}) == 3]
    return positions, orient_by_normals(positions, normals, triangles), normals


def rounded_profile(corners, steps=8):
    """A line through corners of (radius, height, fillet's radius), each replaced by an arc, as (radius, height)."""
    points = [corners[0][:2]]
    for (ax, ay, _), (bx, by, fillet), (cx, cy, _) in zip(corners, corners[1:], corners[2:]):
        u, v = (ax - bx, ay - by), (cx - bx, cy - by)
        lu, lv = math.hypot(*u), math.hypot(*v)
        u, v = (u[0] / lu, u[1] / lu), (v[0] / lv, v[1] / lv)
        half = math.acos(max(-1, min(1, u[0] * v[0] + u[1] * v[1]))) / 2
        reach = min(fillet / math.tan(half), 0.49 * lu, 0.49 * lv)
        start, end = ((bx + reach * w[0], by + reach * w[1]) for w in (u, v))
        for k in range(steps + 1):  # a conic: near enough to the arc, and smooth
            t = k / steps
            weight = math.sin(half)
            parts = ((1 - t) ** 2, 2 * t * (1 - t) * weight, t * t)
            total = sum(parts)
            points.append(tuple((parts[0] * s + parts[1] * b + parts[2] * e) / total for s, b, e in zip(start, (bx, by), end)))
    return points + [corners[-1][:2]]


def solid_of_revolution(points, sectors=96):
    """The closed solid that a profile of (radius, height) sweeps about the y axis. It starts and ends on the axis, the solid to the
    left of its way; normals are smooth."""
    profile = []
    for before, (radius, height), after in zip(points, points[1:], points[2:]):
        a, b = ((q[0] - p[0], q[1] - p[1]) for p, q in ((before, (radius, height)), ((radius, height), after)))
        la, lb = math.hypot(*a), math.hypot(*b)
        across, up = a[1] / la + b[1] / lb, -a[0] / la - b[0] / lb
        length = math.hypot(across, up)
        profile.append((radius, height, across / length, up / length))
    positions, triangles, normals = lathe(profile, sectors)
    for ring, (_, height) in ((0, points[0]), (len(profile) - 1, points[-1])):
        up = math.copysign(1, normals[ring * sectors][1])
        pole = len(positions)
        positions.append((0, height, 0))
        normals.append((0, up, 0))
        triangles += [(pole, ring * sectors + j, ring * sectors + (j + 1) % sectors) for j in range(sectors)]
    return positions, orient_by_normals(positions, normals, triangles), normals


def with_smooth_normals(positions, triangles):
    """The mesh with each vertex's normal the mean of its triangles', by area."""
    normals = [[0, 0, 0] for _ in positions]
    for triangle in triangles:
        a, b, c = (positions[k] for k in triangle)
        e, f = ([q[i] - a[i] for i in range(3)] for q in (b, c))
        n = (e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0])
        for k in triangle:
            normals[k] = [x + y for x, y in zip(normals[k], n)]
    return positions, triangles, [tuple(x / math.hypot(*n) for x in n) for n in normals]


def box(x, y, z):
    """The six quads of a box of these half lengths about the origin, seen from outside."""
    p = lambda i: ((i & 1 or -1) * x, ((i & 2) - 1) * y, ((i & 4) / 2 - 1) * z)
    return [[p(i) for i in face] for face in ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6))]


def orient_by_normals(positions, normals, triangles):
    """Turns triangles so that their fronts look along their normals."""
    turned = []
    for a, b, c in triangles:
        e, f = ([positions[k][i] - positions[a][i] for i in range(3)] for k in (b, c))
        n = (e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0])
        front = sum(n[i] * (normals[a][i] + normals[b][i] + normals[c][i]) for i in range(3)) > 0
        turned.append((a, b, c) if front else (a, c, b))
    return turned


def orient(normals, triangles):
    return orient_by_normals(normals, normals, triangles)


def polygons(faces):
    """Positions and triangles of flat convex polygons, each with corners of its own."""
    positions, triangles = [], []
    for face in faces:
        first = len(positions)
        positions += face
        triangles += [(first, first + i, first + i + 1) for i in range(1, len(face) - 1)]
    return positions, triangles


def cuboid(low, high):
    """The six faces of an axis-aligned box, seen from outside."""
    (a, b, c), (d, e, f) = low, high
    return [[(a, b, f), (d, b, f), (d, e, f), (a, e, f)], [(d, b, c), (a, b, c), (a, e, c), (d, e, c)],
            [(d, b, f), (d, b, c), (d, e, c), (d, e, f)], [(a, b, c), (a, b, f), (a, e, f), (a, e, c)],
            [(a, e, f), (d, e, f), (d, e, c), (a, e, c)], [(a, b, c), (d, b, c), (d, b, f), (a, b, f)]]
