#!/usr/bin/env python3
"""Checks the ratios of README.md in this folder: runs the benchmarks that its table between the two marks names, all
on this machine in the same run. Exit code 1 if a ratio differs from the stated one by more than a third.

    test/bench/figures.py [build]

A row of the table: | question | slow | fast | required | ratio |. `slow` and `fast` are times, named as
- `collision_bench/ROW`: processor time, median of the repetitions;
- `line_bench/ROW/COLUMN`, `plan_table/ROW/COLUMN`: a cell of a table that the program prints, median of the runs;
- the same after `scalar `: with the kernel that treats one lane after the other (ARMLOOM_KERNEL).
Columns begin with the given words. Required ratios are not checked.
"""
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[1]
BEGIN, END = "<!-- figures.py reads this table -->\n", "<!-- end of figures.py's table -->\n"
ARGUMENTS = {"line_bench": ["100", "2000"], "plan_table": [str(TOP / "config/two_pandas.json")]}
RUNS = 3  # of programs without repetitions of their own
OFF = 1 / 3


def stated():
    """Yields (question, slow, fast, ratio) for each row."""
    text = (HERE / "README.md").read_text(encoding="utf-8")
    for line in text.split(BEGIN)[1].split(END)[0].splitlines()[2:]:
        question, slow, fast, _, ratio = (cell.strip() for cell in line.strip("|").split("|"))
        yield question, slow.strip("`"), fast.strip("`"), float(ratio)


def run(program, kernel, arguments):
    environment = {**os.environ, **({"ARMLOOM_KERNEL": kernel} if kernel else {})}
    done = subprocess.run([program, *arguments], env=environment, stdout=subprocess.PIPE, text=True, check=True)
    return done.stdout


def google_benchmarks(program, kernel, rows):
    """Returns the processor time (ns) of each row."""
    names = "|".join(re.escape(row) for row in sorted(rows))
    out = run(program, kernel, [f"--benchmark_filter=^({names})$", "--benchmark_min_time=0.05",
                                "--benchmark_repetitions=7", "--benchmark_enable_random_interleaving=true",
                                "--benchmark_report_aggregates_only=true", "--benchmark_format=json"])
    unit_ns = {"ns": 1, "us": 1e3, "ms": 1e6}
    return {row["run_name"]: row["cpu_time"] * unit_ns[row["time_unit"]]
            for row in json.loads(out)["benchmarks"] if row["aggregate_name"] == "median"}


def printed_cells(out):
    """Returns the numbers of all Markdown tables in `out`, by (row, column)."""
    cells, header = {}, []
    lines = [[cell.strip() for cell in line.strip("|").split("|")] if line.startswith("|") else []
             for line in out.splitlines()]
    for line, following in zip(lines, lines[1:] + [[]]):
        if following and set("".join(following)) <= set("-:"):
            header = line
        elif line and not set("".join(line)) <= set("-:"):
            cells.update({(line[0], column): cell for column, cell in zip(header, line)})
    return cells


def named_cells(program, kernel, rows, outputs):
    """Returns the median, over the outputs, of each cell that `rows` names."""
    found = {}
    for row in rows:
        name, column = row.rsplit("/", 1)
        is_named = re.compile(re.escape(column) + r"\b(?! )").match
        values = [float(cell) for cells in outputs for (of, title), cell in cells.items()
                  if of == name and is_named(title)]
        if len(values) != RUNS:
            sys.exit(f"{program} prints {len(values)} cells named {row} in {RUNS} runs: see README.md")
        found[row] = statistics.median(values)
    return found


def measured(build, names):
    wanted = {}
    for name in names:
        kernel, rest = name.split(" ", 1) if name.startswith("scalar ") else ("", name)
        program, row = rest.split("/", 1)
        wanted.setdefault((program, kernel), set()).add(row)
    times, outputs = {}, {}
    for _ in range(RUNS):  # alternating, so that the machine's load meets all of them
        for program, kernel in wanted:
            if program != "collision_bench":
                out = run(build / program, kernel, ARGUMENTS[program])
                outputs.setdefault((program, kernel), []).append(printed_cells(out))
    for (program, kernel), rows in wanted.items():
        if program == "collision_bench":
            found = google_benchmarks(build / program, kernel, rows)
        else:
            found = named_cells(program, kernel, rows, outputs[program, kernel])
        missing = rows - found.keys()
        if missing:
            sys.exit(f"{program} has no rows {sorted(missing)}: correct README.md")
        times.update({(kernel + " " if kernel else "") + f"{program}/{row}": found[row] for row in rows})
    return times


def main():
    build = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else TOP / "build").resolve()
    rows = list(stated())
    times = measured(build, {name for _, slow, fast, _ in rows for name in (slow, fast)})
    wrong = 0
    for question, slow, fast, ratio in rows:
        now = times[slow] / times[fast]
        off = abs(now / ratio - 1) > OFF
        wrong += off
        print(f"{'off' if off else 'ok ':3}  stated {ratio:8.3g}  measured {now:8.3g}  {question}")
    print(f"{len(rows)} ratios, {wrong} off by more than a third")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
