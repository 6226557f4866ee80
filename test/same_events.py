#!/usr/bin/env python3
"""same_events.py OLD NEW: runs the jobs files of config/ with armloom 0.1 (OLD) and this version (NEW), under every policy and
with faults, and compares the recordings: equal measured states, and equal events but for the names that version 0.2 changed.
Words for people ("detail", "text", names of the server's own jobs) are not compared. Prints a line for each run; exit 1 if one differs.
"""
import json, re, subprocess, sys, tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parents[1]
POLICIES = ['sequential', 'lockstep', 'reservation', 'timed_discrete', 'certified', 'earliest_start', 'coordinated']
CELLS = ['two_pandas', 'four_pandas', 'panda_and_ur5e', 'dual_panda', 'two_shuttles']
FAULTS = [{'at_s': 1.0, 'kind': 'slow', 'for_s': 3.0, 'value': 0.3}, {'at_s': 6.0, 'kind': 'stall', 'for_s': 2.0}]

MEMBERS = {'ring': 'cycle', 'approach': 'move_to_start', 'approach_s': 'move_to_start_s', 'among': 'candidates', 'saves_s': 'time_saved_s',
           'taken': 'selected', 'weighed': 'candidates_evaluated', 'horizon_legs': 'horizon_steps', 'asked_m': 'required_clearance_m'}
WORDS = {'detail', 'text', 'name'}


def renamed(value, key=None):
    """Returns an event of version 0.1 as version 0.2 writes it."""
    if isinstance(value, list): return [renamed(one, key) for one in value]
    if isinstance(value, dict):
        out = {MEMBERS.get(name, name): renamed(one, name) for name, one in value.items()}
        if out.pop('order', None) == 'any': out['reorderable'] = True
        return out
    if key == 'state' and value == 'holding': return 'paused'
    if key == 'kind' and value == 'order': return 'predecessor'
    if isinstance(value, str): return re.sub(r'^aside-(\d+)$', r'retreat-\1', re.sub(r'^approach-(\d+)$', r'move-to-start-\1', value))
    return value


def without_words(value):
    if isinstance(value, list): return [without_words(one) for one in value]
    if isinstance(value, dict): return {key: without_words(one) for key, one in value.items() if not (key in WORDS and isinstance(one, str))}
    return value


def recorded(binary, cell, jobs, policy, faults, folder):
    # Exit 1: not all jobs ended, as after a stop under timed_discrete.
    command = [binary, 'simulate', '--cell', cell, '--jobs', jobs, '--policy', policy, '--seed', '7', '--out', folder, *(['--faults', faults] if faults else [])]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 1): sys.exit(f'{command}: exit {done.returncode}: {done.stderr}')
    events = [json.loads(line) for line in (folder / 'events.jsonl').read_text().splitlines()]
    return events, (folder / 'states.csv').read_bytes()


def difference(old, new):
    (old_events, old_states), (new_events, new_states) = old, new
    if old_states != new_states: return 'measured states'
    if len(old_events) != len(new_events): return f'{len(old_events)} and {len(new_events)} events'
    for number, (a, b) in enumerate(zip(old_events, new_events), 1):
        if without_words(renamed(a)) != without_words(b): return f'event {number}:\n  {json.dumps(renamed(a))}\n  {json.dumps(b)}'
    return None


def main():
    old, new = sys.argv[1:]
    differ = 0
    with tempfile.TemporaryDirectory() as scratch:
        faults, config = Path(scratch) / 'faults.json', Path(scratch) / 'config'
        config.mkdir(), (Path(scratch) / 'models').symlink_to(TOP / 'models')  # cells name robots by ../models
        for name in CELLS:
            jobs = TOP / f'config/{name}_jobs.json'
            arm = re.search(r'"name":\s*"(\w+)",\s*"group"', (TOP / f'config/{name}.json').read_text()).group(1)
            faults.write_text(json.dumps([{**fault, 'arm': arm} for fault in FAULTS]))
            cell_of_old = config / f'{name}.json'
            cell_of_old.write_text((TOP / f'config/{name}.json').read_text().replace('horizon_steps', 'horizon_legs'))
            for policy in POLICIES:
                for given in (None, faults):
                    runs = [recorded(binary, cell, jobs, policy, given, Path(scratch) / f'{side}-{name}-{policy}-{bool(given)}')
                            for side, binary, cell in (('old', old, cell_of_old), ('new', new, TOP / f'config/{name}.json'))]
                    found = difference(*runs)
                    differ += found is not None
                    print(f'{name}, {policy}{", faults" if given else ""}: {len(runs[1][0])} events: {found or "same"}', flush=True)
    return 1 if differ else 0


if __name__ == '__main__':
    sys.exit(main())
