"""Tables and drawings of scripts/benchmark."""

import math
import re

# User CPU-seconds of other renderers, 64 samples, depth 65, measured on a machine of the same kind.
PEERS = {
    "cornell-box": {"size": "256x256", "peers": (27.6, 7.9, 3.4)},
    "veach-mis": {"size": "320x180", "peers": (34.5, 7.5, 3.4)},
    "staircase2": {"size": "192x192", "peers": (31.5, 9.6, 6.5)},
    "staircase": {"size": "144x256", "peers": (32.3, 13.0, 10.7)},
}
COLORS = {"uniform": "#0072b2", "visible": "#009e73", "illuminant": "#e69f00", "optimized": "#d55e00"}


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def peers_table(seconds):
    rows = []
    for name, own in seconds.items():
        known = PEERS.get(name, {"size": "its own", "peers": ()})
        peers = [f"{value:.1f}" for value in known["peers"]] or ["-"] * 3
        rows.append([f"{name} {known['size']}", *peers, f"{own:.2f}"])
    return table(["scene", "pbrt-v4", "Mitsuba 3 scalar_spectral", "Mitsuba 3 llvm_ad_spectral", "Photopic"], rows)


def curves_table(rows):
    """At the most samples: error, time and efficiency, the last relative to four uniform wavelengths."""
    last = max(row["spp"] for row in rows)
    at_last = [row for row in rows if row["spp"] == last]
    body = []
    for row in at_last:
        base = next(
            r for r in at_last if (r["scene"], r["sampler"], r["wavelengths"]) == (row["scene"], "uniform", 4)
        )
        body.append([
            row["scene"], str(row["wavelengths"]), row["sampler"], f"{row['mean_delta_e']:.3f}",
            f"{row['relmse']:.2e}", f"{row['cpu_seconds']:.2f}", f"{row['efficiency'] / base['efficiency']:.2f}",
        ])
    header = ["scene", "N", "sampler", f"mean ΔE at {last} spp", "relMSE", "CPU s", "efficiency"]
    return table(header, body)


def megabytes(value):
    return f"{value / 1e6:.1f}"


def start_table(rows):
    header = ["scene", "ready after s", "CPU s of 1 spp", "peak MB", "of libraries MB", "geometry MB", "textures MB",
              "BVH MB"]
    body = []
    for row in rows:
        parts = [megabytes(row[key]) if key in row else "-" for key in ("geometry", "textures", "bvh")]
        body.append([row["scene"], f"{row['ready']:.3f}", f"{row['user']:.3f}", megabytes(row["memory"]),
                     megabytes(row["libraries"]), *parts])
    return table(header, body)


def update_document(file, tables):
    """Replaces what stands between <!-- NAME --> and <!-- end -->."""
    text = file.read_text()
    for name, content in tables.items():
        pattern = rf"(<!-- {name} -->\n).*?(<!-- end -->)"
        text, count = re.subn(pattern, lambda m: m[1] + content + m[2], text, flags=re.DOTALL)
        if count != 1:
            raise SystemExit(f"benchmark: {file} has no place for the table {name!r}")
    file.write_text(text)


class Panel:
    """A plot with two logarithmic axes in a corner of the drawing."""

    WIDTH, HEIGHT = 190, 150

    def __init__(self, left, top, title, points):
        self.left, self.top = left, top
        xs, ys = zip(*points)
        self.x = (math.log10(min(xs)), math.log10(max(xs)))
        self.y = (math.log10(min(ys)), math.log10(max(ys)))
        self.body = [
            f'<rect x="{left}" y="{top}" width="{self.WIDTH}" height="{self.HEIGHT}" fill="none" stroke="#999"/>',
            f'<text x="{left + self.WIDTH / 2}" y="{top - 6}" text-anchor="middle">{title}</text>',
        ]
        for decade in range(math.ceil(self.y[0]), math.floor(self.y[1]) + 1):
            y = self.place(10 ** self.x[0], 10.0**decade)[1]
            self.body.append(f'<path d="M{left} {y:.1f}h{self.WIDTH}" stroke="#ddd"/>')
            self.body.append(f'<text x="{left - 4}" y="{y + 4:.1f}" text-anchor="end">{10.0**decade:g}</text>')
        for x, anchor in ((min(xs), "start"), (max(xs), "end")):
            place = self.place(x, 10 ** self.y[0])[0]
            self.body.append(
                f'<text x="{place:.1f}" y="{top + self.HEIGHT + 14}" text-anchor="{anchor}">{x:.3g}</text>')

    def place(self, x, y):
        def share(value, ends):
            return (math.log10(value) - ends[0]) / max(ends[1] - ends[0], 1e-9)

        return self.left + self.WIDTH * share(x, self.x), self.top + self.HEIGHT * (1 - share(y, self.y))

    def curve(self, points, color, dashes=""):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in (self.place(*point) for point in points))
        self.body.append(
            f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="1.8" stroke-dasharray="{dashes}"/>')


def curves_svg(rows):
    """A column a scene, four beside each other: mean ΔE over samples, and relMSE over CPU-seconds; four wavelengths
    a path."""
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    four = [row for row in rows if row["wavelengths"] == 4 and row["relmse"] > 0 and row["mean_delta_e"] > 0]
    width, height = 1060, 40 + 430 * ((len(scenes) + 3) // 4)
    body = []
    for column, scene in enumerate(scenes):
        for line, (x, y) in enumerate((("spp", "mean_delta_e"), ("cpu_seconds", "relmse"))):
            own = [row for row in four if row["scene"] == scene]
            title = (f"{scene}: mean ΔE over samples", "relMSE over CPU-seconds")[line]
            left, top = 50 + 250 * (column % 4), 40 + 430 * (column // 4) + 210 * line
            panel = Panel(left, top, title, [(row[x], row[y]) for row in own])
            for sampler, color in COLORS.items():
                panel.curve([(row[x], row[y]) for row in own if row["sampler"] == sampler], color)
            body += panel.body
    for i, (sampler, color) in enumerate(COLORS.items()):
        body.append(f'<path d="M{50 + 130 * i} {height - 16}h24" stroke="{color}" stroke-width="2"/>')
        body.append(f'<text x="{80 + 130 * i}" y="{height - 12}">{sampler}</text>')
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" '
        f'font-size="11" fill="#333"><rect width="100%" height="100%" fill="#fff"/>' + "\n".join(body) + "</svg>\n"
    )
