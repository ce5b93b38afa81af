"""Procedural textures for the scenes: functions of u and v in [0, 1) that repeat, giving sRGB-encoded colours."""

import math


def hashed(*integers):
    """A number in [0, 1) that looks random and is always the same."""
    h = 2166136261
    for i in integers:
        h = (h ^ (i & 0xFFFFFFFF)) * 16777619 & 0xFFFFFFFF
        h ^= h >> 15
    return (h * 2654435761 & 0xFFFFFFFF) / 2**32


def noise(x, y, period_x, period_y, seed):
    """Value noise with smooth steps, in [0, 1); repeats after the periods."""
    i, j = math.floor(x), math.floor(y)
    s, t = ((f * f * (3 - 2 * f)) for f in (x - i, y - j))
    at = lambda a, b: hashed((i + a) % period_x, (j + b) % period_y, seed)
    return (at(0, 0) * (1 - s) + at(1, 0) * s) * (1 - t) + (at(0, 1) * (1 - s) + at(1, 1) * s) * t


def mix(a, b, t):
    return tuple(x * (1 - t) + y * t for x, y in zip(a, b))


def wood(u, v, seed=1, light=(0.72, 0.51, 0.31), dark=(0.42, 0.25, 0.13)):
    """A plank with its grain along u."""
    bend = noise(4 * u, 6 * v, 4, 6, seed)
    rings = 0.5 + 0.5 * math.sin(2 * math.pi * (7 * v + 1.6 * bend))
    fibre = noise(24 * u, 192 * v, 24, 192, seed + 1)
    return mix(light, dark, min(1, 0.55 * rings + 0.35 * fibre))


def parquet(u, v, planks=8):
    """Planks along u, each of its own tone, with dark gaps."""
    row = math.floor(v * planks)
    shift = hashed(row, 77)
    column = math.floor(2 * (u + shift))
    within_u, within_v = 2 * (u + shift) - column, v * planks - row
    if min(within_v, 1 - within_v) < 0.025 or min(within_u, 1 - within_u) < 0.003:
        return (0.16, 0.10, 0.06)
    tone = 1.15 + 0.45 * hashed(row, column % 2, 78)
    return tuple(c * tone for c in wood(u, (within_v + row) / planks, seed=row % 5 + 2))


def weave(u, v, threads=32, one=(0.60, 0.20, 0.16), other=(0.83, 0.76, 0.62)):
    """A carpet of two colours in checks, with the threads' relief."""
    x, y = u * threads, v * threads
    check = (math.floor(x / 4) + math.floor(y / 4)) % 2
    relief = 0.8 + 0.2 * abs(math.sin(math.pi * x) if math.floor(x + y) % 2 else math.sin(math.pi * y))
    return tuple(c * relief for c in (one if check else other))


def painting(u, v):
    """A sunset over hills: bands of strong colour."""
    hills = 0.62 + 0.10 * math.sin(2 * math.pi * (1.5 * u + 0.1)) + 0.05 * math.sin(2 * math.pi * 4 * u)
    if v > hills:
        return mix((0.10, 0.32, 0.22), (0.05, 0.14, 0.16), min(1, 2.5 * (v - hills)))
    if math.hypot(u - 0.66, 0.7 * (v - 0.42)) < 0.09:
        return (1.0, 0.93, 0.62)
    return mix((0.16, 0.24, 0.52), (0.96, 0.55, 0.25), min(1, v / hills))
