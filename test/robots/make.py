#!/usr/bin/env python3
"""Writes the small robots of this folder as a MoveIt user would have them.

    python3 test/robots/make.py OUT      OUT/<module>/cell.json, jobs.json and the robots' files

Every module beside this one that has `write(folder)` is called with a folder of its own. A module
may also say
    LINE, TOLD      the line that its cell lacks, and what Armloom says without it (or line(), told())
    add_line(cell)  puts the line into the cell
    WARNED          what Armloom has to warn of
    NEEDS           a program that is missing here; None: nothing
"""
import importlib
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent


def modules():
    sys.path.insert(0, str(HERE))
    found = [importlib.import_module(path.stem) for path in sorted(HERE.glob("*.py"))
             if path.stem not in ("make", "run_all")]
    return [module for module in found if hasattr(module, "write")]


def make(out):
    """(module, its folder) of each robot that was written."""
    made = []
    for module in modules():
        folder = pathlib.Path(out) / module.__name__
        module.write(folder)
        made.append((module, folder))
    return made


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for module, folder in make(sys.argv[1]):
        print(folder)
