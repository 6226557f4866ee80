#!/usr/bin/env python3
"""Writes the small robots of this folder as a MoveIt user would have them.

    python3 test/robots/make.py OUT      OUT/<module>/cell.json, jobs.json and the robots' files

Calls write(folder) of every module in this folder that has it, each with a separate folder. A module may
also define
    LINE, TOLD      the line that its cell lacks, and Armloom's message without it (or line(), told())
    add_line(cell)  adds the line to the cell
    WARNED          warnings that Armloom must print
    NEEDS           a required program that is missing here, or None
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
    """Returns (module, folder) of each robot that was written."""
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
