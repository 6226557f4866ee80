#!/usr/bin/env python3
"""Damaged robot files: each is refused with exit 2, its file, place and value and what mends it.

    python3 test/robots/damaged.py ARMLOOM OUT

Every damage of damage.py alone, then sets of 2 to 4 independent ones in one file at once, and sets of
one in each of the files: all of them are told in one go.
"""
import itertools
import os
import pathlib
import random
import re
import subprocess
import sys

import damage

SEED, OF_ONE_FILE, OF_ALL_FILES = 11, 80, 20


def bytes_of(text):
    return text if isinstance(text, bytes) else text.encode("latin-1")


def write(folder, damages):
    for name, sound in damage.FILES.items():
        content = bytes_of(sound)
        for one in damages:
            if one.file != name:
                continue
            old = bytes_of(one.old)
            assert content.count(old) == 1, f"{one.old} is {content.count(old)} times in {name}"
            content = content.replace(old, bytes_of(one.new))
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def independent(damages):
    spans = []
    for one in damages:
        text = bytes_of(damage.FILES[one.file])
        start = text.index(bytes_of(one.old))
        spans.append((one.file, start, start + len(bytes_of(one.old))))
    subjects = [(one.file, one.subject) for one in damages if one.subject]
    apart = all(a[0] != b[0] or a[2] <= b[1] or b[2] <= a[1] for a, b in itertools.combinations(spans, 2))
    return apart and len(set(subjects)) == len(subjects)


def fault_of(armloom, folder, damages):
    """What is wrong with how the damages are refused; None: nothing."""
    write(folder, damages)
    done = subprocess.run([armloom, "validate", "--cell", folder / "cell.json"], capture_output=True,
                          text=True, timeout=60)
    if done.returncode != 2:
        return f"exit {done.returncode}\n{done.stderr}"
    said = without_lines(done.stderr)
    missing = [told for one in damages for told in one.told if without_lines(told) not in said]
    if missing:
        return f"not told: {missing}\n{done.stderr}"
    # One damage may move the lines of another one.
    wrong = wrong_lines(done.stderr, damages[0]) if len(damages) == 1 else []
    return f"not the line: {wrong}\n{done.stderr}" if wrong else None


def without_lines(text):
    return re.sub(r"(\.(?:urdf|srdf|yaml)):\d+|(\(line) \d+\)", r"\1\2", text)


def wrong_lines(said, one):
    """What is told of an element of the damaged file in another line than that of the damage."""
    text = damage.FILES[one.file] if isinstance(damage.FILES[one.file], str) else ""
    same = len(os.path.commonprefix([one.old, one.new]))
    line = text[:text.find(one.old) + same].count("\n") + 1
    wrong = []
    for told in one.told:
        if one.hides or not re.match(r"robot\.(urdf|srdf): \w+ \w|joint_limits\.yaml", told):
            continue
        lines = [l for l in said.splitlines() if without_lines(told) in without_lines(l)]
        places = [re.search(re.escape(one.file) + r":(\d+)", l) for l in lines]
        if not any(place and int(place[1]) == line for place in places):
            wrong.append((told, line))
    return wrong


def combinations(damages, rng):
    mild = [one for one in damages if not one.hides]
    files = {file: [one for one in mild if one.file == file] for file in damage.FILES}
    files = {file: of_file for file, of_file in files.items() if of_file}
    made = []
    while len(made) < OF_ONE_FILE:
        of_file = rng.choice(list(files.values()))
        picked = rng.sample(of_file, rng.randint(2, 4))
        if independent(picked):
            made.append(picked)
    # What a group holds decides which limits are needed: a broken one hides those of other files.
    free = [[one for one in of_file if not one.subject] for of_file in files.values()]
    made += [[rng.choice(of_file) for of_file in free if of_file] for _ in range(OF_ALL_FILES)]
    return made


def main():
    armloom, out = sys.argv[1], pathlib.Path(sys.argv[2])
    write(out / "sound", [])
    sound = subprocess.run([armloom, "validate", "--cell", out / "sound/cell.json"], capture_output=True, text=True)
    if sound.returncode != 0 or "warning" in sound.stderr:
        sys.exit(f"the sound cell is not: {sound.stderr}")
    damages = damage.all_damages()
    cases = [[one] for one in damages] + combinations(damages, random.Random(SEED))
    failed = 0
    for case in cases:
        fault = fault_of(armloom, out / "damaged", case)
        if fault is None:
            continue
        failed += 1
        print("FAIL", *(f"{one.file}: {one.old[:60]!r} -> {one.new[:60]!r}" for one in case), fault, sep="\n  ")
    print(f"{len(damages)} damages and {len(cases) - len(damages)} sets of them, {failed} not told as they should")
    sys.exit(failed > 0 or len(damages) < 100)


if __name__ == "__main__":
    main()
