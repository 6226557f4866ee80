"""Builds a copy of the sources with all faults in it; ARMLOOM_FAULT=N switches fault N on. Used by guard/faults.py and
server/faults.py. A fault is (name, file, old text, new text); FAULT in the new text is true while the fault is on."""
import os, re, shutil, signal, subprocess
from pathlib import Path

TOP = Path(__file__).resolve().parents[1]

SWITCH = '''#pragma once
#include <cstdlib>
// Returns true if fault `number` is on; -1: if any fault is on.
inline bool armloom_fault(int number) {
  static const int on = std::getenv("ARMLOOM_FAULT") ? std::atoi(std::getenv("ARMLOOM_FAULT")) : 0;
  return number == -1 ? on != 0 : on == number;
}
'''


def put_in(faults):
    """Returns the changed sources by file, and the faults whose old text does not occur exactly once in their file."""
    texts, missing = {}, []
    for number, (name, file, old, new) in enumerate(faults, 1):
        on = f'(globalThis.process?.env?.ARMLOOM_FAULT === "{number}")' if file.startswith('web/') else f'armloom_fault({number})'
        path = TOP / file
        text = texts.get(file) or (path.read_text() if path.exists() else '')
        if text.count(old) != 1:
            missing.append(f'{name}: found {text.count(old)} times in {file}')
            continue
        texts[file] = text.replace(old, new.replace('FAULT', on))
    return texts, missing


def copy(tree, texts):
    """Copies the sources, with the given texts, to `tree`. Leaves files that are the same, so that they are not built again."""
    files = subprocess.run(['git', '-C', TOP, 'ls-files', '-co', '--exclude-standard', '-z'], capture_output=True, check=True).stdout
    for file in filter(None, files.decode().split('\0')):
        if not (TOP / file).exists(): continue
        data = texts[file].encode() if file in texts else (TOP / file).read_bytes()
        to = tree / file
        if to.exists() and to.read_bytes() == data: continue
        to.parent.mkdir(parents=True, exist_ok=True)
        to.write_bytes(data)
        shutil.copymode(TOP / file, to)
    switch = tree / 'core/base/fault_switch.h'
    if not switch.exists() or switch.read_text() != SWITCH: switch.write_text(SWITCH)


def build(tree, *targets):
    flags = f'-w -include {tree}/core/base/fault_switch.h'  # -w: a fault may make code look odd
    subprocess.run(['cmake', '-S', tree, '-B', tree / 'build', '-G', 'Ninja', '-DCMAKE_BUILD_TYPE=Release', '-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON',
                    f'-DCMAKE_CXX_FLAGS={flags}'], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(['cmake', '--build', tree / 'build', '--target', *targets], check=True, stdout=subprocess.DEVNULL)


def run(tree, program, number, *args, seeds=None, timeout=150):
    """Returns exit code and output of a test program with the fault on; exit code None on timeout."""
    env = dict(os.environ, ARMLOOM_FAULT=str(number))
    if seeds: env['ARMLOOM_SEEDS'] = str(seeds)
    try:
        done = subprocess.run([tree / 'build' / program, '--gtest_brief=1', *args], cwd=tree / 'build', env=env, capture_output=True, text=True, timeout=timeout,
                              preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))  # a background shell ignores it
    except subprocess.TimeoutExpired:
        return None, ''
    return done.returncode, done.stdout + done.stderr


def failed_in(out):
    return sorted(set(re.findall(r'FAILED  \] (\w[^\s,(]*)', out)))
