#!/usr/bin/env python3
"""Puts faults into the driver in Python, one at a time: the conformance suite must find each.

    test/server/broken_drivers.py ARMLOOM [--only TEXT]
"""
import concurrent.futures
import pathlib
import re
import shutil
import sys
import tempfile

from driver_conforms import DRIVERS, conforms, running

ARM, DRIVER = "example_arm.py", "example_driver.py"
RUNS = 8  # on a busy machine, the driver is late, and a check may miss a fault

# Fault, file, old text, new text, the check that must find it, words of its message (a regular expression).
FAULTS = [
    ("brakes at once", ARM, "max(wanted, self.rate - fall)", "wanted",
     "brakes_on_the_path_and_continues", "brakes harder"),
    ("stops at its authority at once", ARM, "return min(1.0, (2 * max(left, 0.0)) ** 0.5)", "return 1.0",
     "keeps_the_limits_from_rest_to_rest", "brakes harder"),
    ("brakes at once at speed 0", ARM, 'self.share = command["share"]',
     'self.share = command["share"]; self.rate = min(self.rate, self.share)',
     "takes_or_rejects_a_speed", "brakes harder"),
    ("accelerates at once", ARM, "self.rate + rise)", "self.rate + 1.0)",
     "keeps_the_limits_from_rest_to_rest", "accelerates harder"),
    ("brakes at half of the limit", ARM, "0.02 * brake) / first", "0.02 * brake) / first / 2",
     "brakes_as_strongly_as_it_promises", "promised"),
    ("begins to brake after 50 ms", ARM, 'wanted = 0.0 if self.phase == "braking" else',
     'self.late = (getattr(self, "late", 0) + 1) * (self.phase == "braking")\n        wanted = 0.0 if self.late > 12 else',
     "brakes_as_strongly_as_it_promises", "promised"),
    ("moves faster than planned", ARM, "period_s * 1e9)\n        self.at", "period_s * 1.1e9)\n        self.at",
     "follows_to_the_goal", "faster than planned"),
    ("leaves its path", ARM, "now_at.get(joint, old) for", "now_at.get(joint, old) + 0.1 * self.rate for",
     "follows_to_the_goal", "off its path"),
    ("finishes early", ARM, "if self.at == self.path.duration:", "if self.at > 0.9 * self.path.duration:",
     "follows_to_the_goal", "before the goal"),
    ("passes its authority", ARM, "end = min(self.authority, self.path.duration)", "end = self.path.duration",
     "rests_at_its_authority", "passed its authority"),
    ("rests before its authority", ARM, "end = min(self.authority, self", "end = min(self.authority - self.authority // 100, self",
     "rests_at_its_authority", "in vain for"),
    ("takes an authority that it cannot keep", ARM,
     'max(command["authority_ns"], self.path.rest_after(self.at, self.rate))', 'command["authority_ns"]',
     "raises_an_authority_too_close_for_a_brake", "backwards"),
    ("starts at once", ARM, "now >= (self.start_at or 0)", "True", "starts_at_the_time_and_not_before", "early"),
    ("obeys repeats", ARM, '!= self.acknowledged + 1', 'not in (self.acknowledged, self.acknowledged + 1)',
     "ignores_repeats_and_gaps", "repeat"),
    ("obeys after a gap", ARM, '!= self.acknowledged + 1', '<= self.acknowledged',
     "ignores_repeats_and_gaps", "gap"),
    ("ends a stop when its authority grows", ARM, "        if self.phase in self.UNDER_WAY:\n            self.auth",
     '        if self.phase == "stopped":\n            self.phase = "moving"\n        if True:\n            self.auth',
     "brakes_on_the_path_and_continues", "without a command"),
    ("misstates where a brake ends", ARM, "self.path.rest_after(self.at, self.rate), max(", "self.at, max(",
     "says_where_a_brake_ends", "rests at"),
    ("keeps the drives on", ARM, "self.switches_off = category < 2", "self.switches_off = False",
     "switches_the_drives_off", "drives that are off"),
    ("keeps the path without drives", ARM, "if category == 0 and", "if category == 9 and",
     "switches_the_drives_off", "path was kept"),
    ("follows from anywhere", ARM, "if not away <= self.tolerance:", "if False:",
     "rejects_what_it_cannot_do", "was not rejected"),
    ("drops a motion under way", ARM, '    def release(self, command):\n        if self.phase in self.UNDER_WAY:',
     '    def release(self, command):\n        if False:', "rejects_what_it_cannot_do", "was not rejected"),
    ("ignores speeds", ARM, 'self.share = command["share"]', "pass", "takes_or_rejects_a_speed", "of the planned rate|at speed 0"),
    ("repeats sequence numbers", ARM, "self.sequence += 1", "pass", "follows_to_the_goal", "sequence"),
    ("reports too seldom", DRIVER, 'hello["timeout_s"], hello["feedback_period_s"]',
     'hello["timeout_s"], 2 * hello["feedback_period_s"]', "reports_in_time", "too few"),
    ("promises too little", DRIVER, '"reaction_s": self.period_s', '"reaction_s": 1.0',
     "welcome_keeps_the_promises", "longer"),
    ("has a clock that stands", DRIVER, '"controller_time_ns": time.monotonic_ns()', '"controller_time_ns": 7',
     "answers_heartbeats_with_its_clock", "stands still"),
    ("speaks every version", DRIVER, 'hello["protocol"] != PROTOCOL', "False",
     "refuses_another_version", "not refused"),
    ("serves two servers", DRIVER, 'self.server and hello["session"] != self.session', "False",
     "refuses_a_second_server", "not refused"),
    ("is any robot", DRIVER, 'hello["robot"] != self.robot["robot"]', "False", "refuses_another_robot", "not refused"),
    ("has any arms", DRIVER, "names[0] != names[1]", "False", "refuses_other_arms_or_joints", "not refused"),
    ("has any joints", DRIVER, "names[0] != names[1]", "[arm for arm, _ in names[0]] != list(self.arms)",
     "refuses_other_arms_or_joints", "not refused"),
    ("has any limits", DRIVER, "wanted[limit] > limits[limit]", "False", "refuses_higher_limits", "not refused"),
    ("keeps the connection after a refusal", DRIVER, '"detail": detail})\n            peer.socket.close()',
     '"detail": detail})\n            self.kept = peer', "refuses_another_robot", "keeps the connection"),
    ("ignores unknown members", DRIVER, "set(part) != members", "not members <= set(part)",
     "ends_the_connection_after_a_wrong_message", "no_member"),
    ("ignores unknown members of the hello", DRIVER, "set(part) != members", "not members <= set(part)",
     "refuses_a_hello_with_wrong_members", "keeps the connection"),
    ("ignores missing members", DRIVER, "set(part) != members", "not set(part) <= members",
     "refuses_a_hello_with_wrong_members", "keeps the connection"),
    ("ignores unknown arms", DRIVER, 'self.arms[message["arm"]].obey', 'self.arms["right"].obey',
     "ends_the_connection_after_a_wrong_message", "no_arm"),
    ("ignores bad lines", DRIVER, "return [parse(line) for line in lines]",
     'return [parse(line) for line in lines if line.endswith(b"}")]',
     "ends_the_connection_after_a_bad_line", "keeps the connection"),
    ("moves on without a connection", DRIVER, 'self.brake(f"the server is gone: {error}")', "pass",
     "brakes_when_the_connection_ends", "not stopped|did not brake"),
    ("moves on without heartbeats", DRIVER, "and not self.silent and time", "and False and time",
     "brakes_without_heartbeats", "not stopped"),
    ("forgets the numbers of a session", DRIVER, 'if hello["session"] != self.session:\n                arm',
     "if True:\n                arm",
     "brakes_when_the_connection_ends", "not stopped"),
    ("counts on in another session", DRIVER, 'if hello["session"] != self.session:\n                arm',
     "if False:\n                arm",
     "drops_the_motion_of_another_session", "another session"),
]


def found(program, fault):
    """Returns what is wrong with the suite; empty if it finds the fault."""
    _, file, old, new, check, words = fault
    source = (DRIVERS / file).read_text()
    if source.count(old) != 1:
        return f"the fault fits {source.count(old)} places of {file}"
    with tempfile.TemporaryDirectory(prefix="armloom-broken-") as folder:
        for name in (ARM, DRIVER):
            shutil.copy(DRIVERS / name, folder)
        (pathlib.Path(folder) / file).write_text(source.replace(old, new))
        with running(program, "python", pathlib.Path(folder)) as (endpoint, hello):
            for _ in range(RUNS):
                result = conforms(endpoint, hello, "--only", check, capture_output=True, text=True)
                if re.match(f"FAILED   {check} - .*({words})", result.stdout):
                    return ""
    return f"not found: {result.stdout} {result.stderr[-300:]}"


def main():
    program, *options = sys.argv[1:]
    faults = [fault for fault in FAULTS if not options or options[1] in fault[0]]
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        wrong = list(pool.map(lambda fault: found(program, fault), faults))
    for fault, why in zip(faults, wrong):
        print("FAILED  " if why else "ok      ", fault[0], why, flush=True)
    print(f"{len(faults)} faults, {sum(map(bool, wrong))} not found")
    return 1 if any(wrong) or not faults else 0


if __name__ == "__main__":
    sys.exit(main())
