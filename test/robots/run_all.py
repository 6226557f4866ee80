#!/usr/bin/env python3
"""Runs every small robot of this folder like a user: validate, simulate, audit.

    python3 test/robots/run_all.py ARMLOOM OUT

If a cell lacks a line, `validate` must reject it and suggest that line. With the line: no problem, all
expected warnings, at least 12 jobs that all succeed, and an audit without contact.
"""
import json
import shutil
import subprocess
import sys

import make


def run(armloom, *arguments):
    return subprocess.run([armloom, *map(str, arguments)], capture_output=True, text=True, timeout=120)


def check(claim, holds, found):
    print(f"{'ok  ' if holds else 'FAIL'} {claim}")
    if not holds:
        sys.exit(str(found)[-3000:])


def said(module, name):
    return getattr(module, name.lower())() if hasattr(module, name.lower()) else getattr(module, name, None)


def add_missing_line(armloom, name, module, cell_file):
    refused = run(armloom, "validate", "--cell", cell_file)
    check(f"{name} is rejected without its line", refused.returncode == 2, refused)
    told = said(module, "TOLD")
    check(f"{name} reports: {told}", told in refused.stderr, refused.stderr)
    problems = [line for line in refused.stderr.splitlines() if "warning:" not in line]
    check(f"every problem of {name} suggests a line to add", all("add to the" in p for p in problems), problems)
    cell = json.loads(cell_file.read_text())
    module.add_line(cell)
    cell_file.write_text(json.dumps(cell, indent=1))


def run_robot(armloom, module, folder):
    name, cell, jobs = module.__name__, folder / "cell.json", folder / "jobs.json"
    missing = getattr(module, "NEEDS", None)
    if missing:
        refused = run(armloom, "validate", "--cell", cell)
        check(f"{name} without {missing} reports how to do it by hand",
              refused.returncode == 2 and f"{missing} is not installed" in refused.stderr, refused)
        print(f"SKIP the rest of {name}: there is no {missing} here")
        return False
    if hasattr(module, "add_line"):
        add_missing_line(armloom, name, module, cell)
    validated = run(armloom, "validate", "--verbose", "--cell", cell)
    check(f"nothing is wrong with {name}", validated.returncode == 0, validated)
    for warning in getattr(module, "WARNED", ()):
        check(f"{name} warns: {warning}", warning in validated.stderr, validated.stderr)
    if not hasattr(module, "WARNED"):
        check(f"{name} warns of nothing", "warning" not in validated.stderr, validated.stderr)

    recording = folder / "recording"
    shutil.rmtree(recording, ignore_errors=True)
    total = len(json.loads(jobs.read_text()))
    simulated = run(armloom, "simulate", "--cell", cell, "--jobs", jobs, "--out", recording)
    check(f"{name} runs", simulated.returncode == 0, simulated)
    result = json.loads(simulated.stdout.strip().splitlines()[-1])
    check(f"all {total} jobs of {name} succeed, at least 12",
          total >= 12 and result["jobs"].get("succeeded") == total, result)
    audited = run(armloom, "audit", "--cell", cell, "--recording", recording)
    check(f"the audit of {name} finds nothing", audited.returncode == 0, audited)
    return True


def main():
    armloom, out = sys.argv[1:]
    ran = [run_robot(armloom, module, folder) for module, folder in make.make(out)]
    print(f"{sum(ran)} of {len(ran)} robots ran")
    check("at least 5 robots ran", sum(ran) >= 5, ran)


if __name__ == "__main__":
    main()
