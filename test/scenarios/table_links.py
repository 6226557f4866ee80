#!/usr/bin/env python3
"""A table and a shelf as links of a URDF, and as objects of the cell: all answers are the same.

    test/scenarios/table_links.py ARMLOOM

The robot is that of test/robots/table_links.py. Verdicts of `check`, the events, states and figures
of `simulate` and those of `audit` are compared, under every method of checking; and that each holds
the cell's clearance, as nothing would be shown by two that were wrong in the same way.
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP / "test/robots"))
import table_links  # noqa: E402

CELLS = {"links": "cell.json", "objects": "cell_objects.json"}
METHODS = ("timed_discrete", "certified", "reservation", "coordinated")


def run(armloom, *arguments, expect=0):
    done = subprocess.run([armloom, *map(str, arguments)], capture_output=True, text=True,
                          timeout=300)
    if done.returncode != expect:
        sys.exit(f"armloom {' '.join(map(str, arguments))}: exit {done.returncode}, expected "
                 f"{expect}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def check(claim, holds, figure=""):
    print(f"{'ok  ' if holds else 'FAIL'} {claim}: {figure}")
    if not holds:
        sys.exit(1)


def one_name(text):
    """Objects of one link are told apart by a number; the link has one name. An object can be moved
    or deleted to open a way, a link cannot."""
    text = text.replace(", or the object moved or deleted,", "")
    return re.sub(r'\b(table|shelf)_\d+\b', r'\1', text)


def differing(texts):
    lines = [text.splitlines() for text in texts]
    for i, (a, b) in enumerate(zip(*lines)):
        if a != b:
            return f"line {i + 1}:\n  {a[:600]}\n  {b[:600]}"
    return None if len(lines[0]) == len(lines[1]) else f"{len(lines[0])} and {len(lines[1])} lines"


def check_same(claim, texts):
    difference = differing([one_name(text) for text in texts])
    check(claim, difference is None, difference or f"{len(texts[0])} B")


def verdicts(armloom, folder):
    """Probes: those that come closer than clearance_m conflict with what they come close to."""
    for method in METHODS:
        said = {kind: run(armloom, "check", "--cell", folder / name, "--jobs",
                          folder / "probes.json", "--policy", method)
                for kind, name in CELLS.items()}
        check_same(f"verdicts of {method}", list(said.values()))
        lines = [json.loads(line) for line in said["links"].splitlines() if line.startswith("{")]
        lines = [line for line in lines if "verdict" in line]
        check("every probe is judged", len(lines) == len(table_links.probes()), len(lines))
        free = [line for line in lines if line["verdict"] == "free"]
        met = [line["conflicts"][0] for line in lines if line["verdict"] == "conflict"]
        of_scene = [conflict for conflict in met
                    if conflict["links"] and conflict["links"][1] in table_links.BOXES]
        check("some are free, and some meet table or shelf", len(free) >= 10 and len(of_scene) >= 10,
              f"{len(free)}, {len(of_scene)}")
        check("what is met is told as an object is", all(conflict["kind"] == "object"
                                                         for conflict in of_scene))
        # The first 28: two arms, over table and lower board, seven gaps each.
        for line, gap in zip(lines[:28], (0.0015, 0.0094, 0.015, 0.019, 0.0215, 0.024, 0.04) * 4):
            if gap < 0.02:
                check(f"{gap} m is too close", line["verdict"] == "conflict", line["verdict"])
            elif gap > 0.022:
                check(f"{gap} m is free", line["verdict"] == "free", line["verdict"])


def runs(armloom, folder):
    for method in METHODS:
        events, results, audits = [], [], []
        for kind, name in CELLS.items():
            out = folder / f"{method}-{kind}"
            said = run(armloom, "simulate", "--cell", folder / name, "--jobs", folder / "jobs.json",
                       "--policy", method, "--seed", 3, "--out", out)
            results.append(json.loads(said.splitlines()[-1]))
            results[-1].pop("wall_s")
            events.append((out / "events.jsonl").read_text())
            audits.append(run(armloom, "audit", "--cell", folder / name, "--recording", out))
        check_same(f"events of {method}", events)
        check_same(f"figures of {method}", [json.dumps(result) for result in results])
        audited = [json.loads(one_name(said).splitlines()[-1]) for said in audits]
        check("the audit's smallest clearance",
              abs(audited[0]["smallest_clearance_m"] - audited[1]["smallest_clearance_m"]) < 1e-9,
              [said["smallest_clearance_m"] for said in audited])
        check("all succeed", results[0]["jobs"]["succeeded"] == len(table_links.twelve_jobs()),
              results[0]["jobs"])
        clearance_m = audited[0]["smallest_clearance_m"]
        check("they keep the clearance from table and shelf", clearance_m >= 0.02, clearance_m)
        check("simulate saw the same", abs(results[0]["min_clearance_m"] - clearance_m) < 1e-3,
              results[0]["min_clearance_m"])


def stops(armloom, folder):
    """A check that sees only the ends of a motion admits it: the monitor stops it."""
    events, results = [], []
    for kind, name in CELLS.items():
        cell = json.loads((folder / name).read_text())
        cell["checking"] = {"time_step_s": 10}
        cell["scheduling"]["backlog_timeout_s"] = 5
        blind = folder / f"blind_{name}"
        blind.write_text(json.dumps(cell))
        out = folder / f"stops-{kind}"
        said = run(armloom, "simulate", "--cell", blind, "--jobs", folder / "dips.json",
                   "--policy", "timed_discrete", "--out", out, expect=1)  # nobody resumes
        results.append(json.loads(said.splitlines()[-1]))
        results[-1].pop("wall_s")
        events.append((out / "events.jsonl").read_text())
    check_same("events of stops", events)
    check_same("figures of stops", [json.dumps(result) for result in results])
    found = [event["data"] for event in map(json.loads, events[0].splitlines())
             if event["type"] == "monitor"]
    stopped = {(event["links"][1], *event["stopped"]) for event in found}
    check("the monitor stops both, at table and shelf",
          stopped == {("table", "left"), ("shelf", "right")}, sorted(stopped))
    check("below stop_clearance_m", all(event["clearance_m"] < 0.01 for event in found))


def main():
    armloom = sys.argv[1]
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        table_links.write(folder)
        verdicts(armloom, folder)
        runs(armloom, folder)
        stops(armloom, folder)


if __name__ == "__main__":
    main()
