#!/usr/bin/env python3
"""Growth of the decision time: runs `scheduler_bench --benchmark_filter=growth/`, writes its table into
README.md in this folder, between the two marks, and the picture to growth.svg.

    test/bench/growth.py [build/scheduler_bench]
"""
import json
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
BEGIN, END = "<!-- growth.py begins -->\n", "<!-- growth.py ends -->\n"
# By name of the benchmark's row: the counter that grows, and its caption.
ROWS = {
    "horizon": ("horizon_steps", "motions per arm in the horizon"),
    "waiting": ("waiting", "waiting jobs"),
    "spacing_cm": ("in_reach", "arms in reach"),
}
WIDTH, HEIGHT, LEFT, TOP, PLOT = 900, 260, 50, 30, 220


def measured(bench):
    done = subprocess.run([bench, "--benchmark_filter=growth/", "--benchmark_format=json"],
                          capture_output=True, text=True, check=True)
    series = {name: [] for name in ROWS}
    for row in json.loads(done.stdout)["benchmarks"]:
        name = row["name"].split("/")[1].split(":")[0]
        series[name].append((row[ROWS[name][0]], row["median_ms"], row["p99_ms"], row["scheduled"]))
    return {name: sorted(rows) for name, rows in series.items()}


def table(series):
    lines = []
    for name, rows in series.items():
        lines += ["", "| " + ROWS[name][1] + " | " + " | ".join(f"{row[0]:g}" for row in rows) + " |",
                  "|---" * (len(rows) + 1) + "|",
                  "| median, ms | " + " | ".join(f"{row[1]:.2f}" for row in rows) + " |",
                  "| 99 %, ms | " + " | ".join(f"{row[2]:.2f}" for row in rows) + " |",
                  "| also admitted | " + " | ".join(f"{row[3]:g}" for row in rows) + " |"]
    return "\n".join(lines[1:]) + "\n"


def picture(series):
    most = max(row[2] for rows in series.values() for row in rows)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" '
           'font-family="sans-serif" font-size="11">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>']
    for k, (name, rows) in enumerate(series.items()):
        left = LEFT + k * (PLOT + 65)
        across = lambda x, last=rows[-1][0]: left + PLOT * x / (last or 1)
        down = lambda y: TOP + 180 * (1 - y / most)
        out.append(f'<path d="M{left} {TOP}V{TOP + 180}H{left + PLOT}" fill="none" stroke="#808080"/>')
        for tick in (0, most / 2, most):
            out.append(f'<text x="{left - 5}" y="{down(tick) + 4:.1f}" text-anchor="end">{tick:.1f}</text>')
        for x in {rows[0][0], rows[-1][0]}:
            out.append(f'<text x="{across(x):.1f}" y="{TOP + 194}" text-anchor="middle">{x:g}</text>')
        out.append(f'<text x="{left + PLOT / 2}" y="{TOP + 210}" text-anchor="middle">{ROWS[name][1]}</text>')
        for column, colour in ((1, "#1f5fa8"), (2, "#c0563a")):
            points = [(across(row[0]), down(row[column])) for row in rows]
            out.append(f'<polyline fill="none" stroke="{colour}" stroke-width="2" points="' +
                       " ".join(f"{x:.1f},{y:.1f}" for x, y in points) + '"/>')
            out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{colour}"/>' for x, y in points]
    out.append(f'<text x="{LEFT}" y="16">a decision, ms: median (blue), 99 % (red)</text>')
    return "\n".join(out + ["</svg>"]) + "\n"


def main():
    bench = sys.argv[1] if len(sys.argv) > 1 else HERE.parents[1] / "build/scheduler_bench"
    series = measured(bench)
    readme = HERE / "README.md"
    text = readme.read_text(encoding="utf-8")
    before, rest = text.split(BEGIN)
    _, after = rest.split(END)
    readme.write_text(before + BEGIN + table(series) + END + after, encoding="utf-8")
    (HERE / "growth.svg").write_text(picture(series), encoding="utf-8")
    print(table(series), end="")


if __name__ == "__main__":
    main()
