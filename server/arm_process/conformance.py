#!/usr/bin/env python3
"""Tests that a robot driver keeps Armloom's protocol (PROTOCOL.md).

    armloom arm --cell CELL --robot NAME --hello > hello.json
    conformance.py ENDPOINT hello.json [--only CHECK ...]

HAZARD: the first arm of the robot moves its first joint by 0.2 rad from where it is, many times. Keep the space clear.
Prints a line for each check. Exit 0: all passed.
"""
import argparse
import json
import pathlib
import re
import select
import socket
import sys
import time
import uuid

SWING = 0.2  # rad or m
PATIENCE_S = 20.0  # for an event; a busy machine is slow
MOVING = ("moving", "braking")


class Broken(Exception):
    """The driver breaks the protocol."""


def expect(holds, what):
    if not holds:
        raise Broken(what)


class Refused(Broken):
    """The driver sent an error."""


class Motion:
    """A motion of the arm's first joint from rest to rest and its command."""

    def __init__(self, terms, positions, slower=1.0):
        self.terms, self.begin = terms, positions
        first = terms[0]
        # A quintic from rest to rest has at most 1.875 d/T velocity and 5.774 d/T^2 acceleration.
        least_s = max(1.875 * SWING / first["velocity"], (5.774 * SWING / first["acceleration"]) ** 0.5)
        self.duration = round(max(1.2 * least_s, 0.8) * slower * 1e9)
        t = self.duration / 1e9
        away = SWING if abs(positions[0]) < SWING else -SWING * positions[0] / abs(positions[0])
        self.rows = [[position, 0, 0, 0, 0, 0] for position in positions]
        self.rows[0] = [positions[0], 0, 0, 10 * away / t**3, -15 * away / t**4, 6 * away / t**5]

    def at(self, progress):
        t = progress / 1e9
        return [sum(c * t**k for k, c in enumerate(row)) for row in self.rows]

    def follow(self, start=0, authority=None, start_at=None):
        half = self.duration // 2  # two pieces, so that a seam is passed
        t = half / 1e9
        shifted = [[sum(row[k] * choose(k, j) * t ** (k - j) for k in range(j, 6)) for j in range(6)] for row in self.rows]
        return {"type": "follow", "start_at_ns": start_at, "from_ns": start, "joints": self.terms,
                "authority_ns": self.duration if authority is None else authority,
                "pieces": [{"duration_ns": half, "coefficients": self.rows},
                           {"duration_ns": self.duration - half, "coefficients": shifted}]}


def choose(n, k):
    result = 1
    for i in range(k):
        result = result * (n - i) // (i + 1)
    return result


class Server:
    """The server's end of a connection."""

    def __init__(self, endpoint, hello, session=None, welcome=True, **changes):
        self.hello = {**hello, "session": session or str(uuid.uuid4()), **changes}
        self.arm, self.data, self.report, self.reports = hello["arms"][0], b"", None, 0
        self.motion, self.error, self.beat_at, self.number, self.silent = None, None, 0.0, 0, False
        self.socket = connect(endpoint)
        self.send(self.hello)
        try:
            self.welcome = self.next("welcome" if welcome else "error")
        except Refused:  # the driver may need a moment to notice the end of the connection before
            time.sleep(0.2)
            self.socket, self.data = connect(endpoint), b""
            self.send(self.hello)
            self.welcome = self.next("welcome")
        if welcome:
            self.until(lambda report: True, "a report")
            self.number = self.report["acknowledged"]

    def close(self):
        self.socket.close()

    def send(self, message):
        self.socket.sendall(json.dumps(message).encode() + b"\n")

    def next(self, kind):
        """Returns the next message of this kind; answers heartbeats and checks reports."""
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            if not self.silent and time.monotonic() > self.beat_at:
                self.beat_at = time.monotonic() + self.hello["timeout_s"] / 5
                if kind not in ("welcome", "error"):
                    self.send({"type": "heartbeat", "time_ns": time.monotonic_ns()})
            line, newline, rest = self.data.partition(b"\n")
            if not newline:
                if select.select([self.socket], [], [], 0.01)[0]:
                    chunk = self.socket.recv(1 << 20)
                    expect(chunk, f"the driver closed the connection before {kind}")
                    self.data += chunk
                continue
            self.data = rest
            message = json.loads(line)
            if message["type"] == "feedback" and message["arm"] == self.arm["name"]:
                self.check(message)
            if message["type"] == kind and message.get("arm", self.arm["name"]) == self.arm["name"]:
                return message
            if message["type"] == "error":
                raise Refused(f"refused: {message.get('pointer')}: {message.get('detail')}")
        raise Broken(f"no {kind} within {PATIENCE_S} s")

    def check(self, report):
        last, self.report = self.report, report
        self.reports += 1
        expect(len(report["positions"]) == len(self.arm["joints"]), "a report lacks positions")
        if last:
            expect(report["sequence"] > last["sequence"], "sequence does not grow")
            expect(report["time_ns"] >= last["time_ns"], "time_ns runs backwards")
            expect(report["acknowledged"] >= last["acknowledged"], "acknowledged falls")
            if last["phase"] in MOVING and report["phase"] in MOVING + ("stopped", "finished"):
                expect(report["commanded_ns"] >= last["commanded_ns"], "moves backwards on its path")
        expect(report["measured_ns"] <= report["commanded_ns"], "measured progress is ahead of commanded progress")
        if report["phase"] in MOVING + ("stopped", "finished"):
            expect(report["commanded_ns"] <= report["authority_ns"],
                   f"passed its authority: {report['commanded_ns']} > {report['authority_ns']}")
        if self.motion and report["phase"] in MOVING + ("stopped", "finished"):
            on_path = [self.motion.at(report[which]) for which in ("measured_ns", "commanded_ns")]
            for joint, position in enumerate(report["positions"]):
                ends = sorted(q[joint] for q in on_path)
                off = max(ends[0] - position, position - ends[1])
                expect(off < 0.02, f"joint {joint} is {off:.4f} off its path")

    def until(self, holds, what):
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            if holds(self.next("feedback")):
                return self.report
        raise Broken(f"waited in vain for {what}; the last report: {self.report}")

    def command(self, message, answers="acknowledged"):
        """Sends a command and waits until it is acknowledged; `answers`: or "rejected"."""
        self.number += 1
        number = self.number
        self.send({"arm": self.arm["name"], "number": number, **message})
        report = self.until(lambda said: said["acknowledged"] >= number, "an acknowledgement of " + message["type"])
        rejected = report["rejected"] == number
        expect(rejected == (answers == "rejected"),
               f"{message['type']} was {'rejected: ' + report['detail'] if rejected else 'not rejected'}")
        return report

    def swing(self, slower=1.0, **how):
        self.until(lambda report: report["phase"] not in ("waiting", *MOVING), "the end of an earlier motion")
        self.motion = Motion(self.arm["joints"], self.report["positions"], slower)
        self.command(self.motion.follow(**how))
        return self.motion

    def phase(self, *phases):
        return self.until(lambda report: report["phase"] in phases, " or ".join(phases))

    def halfway(self, share=0.3):
        return self.until(lambda report: report["commanded_ns"] > share * self.motion.duration, "progress")

    def stays_at_rest(self):
        still = self.report["commanded_ns"], self.report["phase"]
        for _ in range(30):
            report = self.next("feedback")
            expect((report["commanded_ns"], report["phase"]) == still, f"moves without a command: {report}")


def connect(endpoint):
    kind, _, place = endpoint.partition(":")
    if kind == "unix":
        made = socket.socket(socket.AF_UNIX)
        made.connect(place)
        return made
    host, _, port = place.rpartition(":")
    return socket.create_connection((host, int(port)))


# ---- Checks. Each begins with a new session; `new(...)` makes a connection. ----

def check_welcome_keeps_the_promises(new):
    server = new()
    expect(server.welcome["robot"] == server.hello["robot"], "another robot answers")
    expect([arm["joints"] for arm in server.welcome["arms"]]
           == [[joint["name"] for joint in arm["joints"]] for arm in server.hello["arms"]], "other joints")
    for promise in ("reaction_s", "feedback_period_s"):
        expect(server.welcome[promise] <= server.hello[promise], f"{promise} is longer than the cell file's")


def check_refuses_another_version(new):
    server = new(welcome=False, protocol=99)
    expect(server.welcome["pointer"] == "/protocol" and server.welcome["detail"], "the error names no place")


def check_refuses_a_second_server(new):
    first = new()
    second = new(welcome=False)
    expect(second.welcome["pointer"] == "/session" and second.welcome["detail"], "the error names no place")
    first.swing()
    first.phase("finished")


def check_answers_heartbeats_with_its_clock(new):
    server = new()
    first, second = server.next("heartbeat"), server.next("heartbeat")
    passed = second["controller_time_ns"] - first["controller_time_ns"]
    expect(passed > 0 and first["time_ns"] < second["time_ns"], "a clock stands still")


def check_follows_to_the_goal(new):
    server = new()
    motion = server.swing()
    report = server.phase("finished")
    expect(report["commanded_ns"] == motion.duration and report["at_rest"], "finished before the goal")
    server.stays_at_rest()
    expect(server.command({"type": "release"})["phase"] == "idle", "not idle after the release")


def check_starts_at_the_time_and_not_before(new):
    server = new()
    beat = server.next("heartbeat")
    start_at = beat["controller_time_ns"] + 400_000_000
    server.swing(start_at=start_at)
    report = server.until(lambda said: said["commanded_ns"] > 0, "a start")
    expect(report["time_ns"] >= start_at, f"started {start_at - report['time_ns']} ns early")


def check_ignores_repeats_and_gaps(new):
    server = new()
    motion = server.swing(authority=0)
    follow = {**motion.follow(), "arm": server.arm["name"], "number": server.number}
    server.send(follow)  # a repeat, with other content
    server.send({"type": "extend", "arm": server.arm["name"], "number": server.number + 5,
                 "authority_ns": motion.duration})
    for _ in range(30):
        report = server.next("feedback")
        expect(report["acknowledged"] == server.number, "acknowledged a repeat or a gap")
        expect(report["commanded_ns"] == 0, "obeyed a repeat or a gap")
    server.command({"type": "extend", "authority_ns": motion.duration})
    server.phase("finished")


def check_rests_at_its_authority(new):
    server = new()
    motion = server.swing(authority=0)
    for share in (0.3, 0.35, 0.6):
        authority = int(share * motion.duration)
        server.command({"type": "extend", "authority_ns": authority})
        report = server.until(lambda said: said["at_rest"] and said["measured_ns"] == said["commanded_ns"] > 0, "a rest")
        server.until(lambda said, end=authority: said["commanded_ns"] == end, "the authority")
        expect(report["authority_ns"] == authority, "reports another authority")
    server.command({"type": "extend", "authority_ns": motion.duration})
    server.phase("finished")


def check_raises_an_authority_too_close_for_a_brake(new):
    server = new()
    server.swing()
    at = server.halfway()["commanded_ns"]
    report = server.command({"type": "extend", "authority_ns": at // 2})
    expect(report["authority_ns"] >= report["commanded_ns"], "reports an authority that it has passed")
    report = server.until(lambda said: said["at_rest"], "a rest")
    expect(report["commanded_ns"] <= report["authority_ns"], "passed its authority")


def check_brakes_on_the_path_and_continues(new):
    server = new()
    motion = server.swing()
    at = server.halfway()["commanded_ns"]
    server.command({"type": "brake", "category": 2})
    report = server.phase("stopped")
    expect(report["at_rest"] and at <= report["commanded_ns"] < motion.duration, "not at rest on its path")
    server.stays_at_rest()
    expect(server.report["drives_on"], "category 2 switches the drives off")
    server.command({"type": "extend", "authority_ns": motion.duration})
    server.stays_at_rest()  # authority does not end a stop
    server.command(motion.follow(start=server.report["measured_ns"]))
    server.phase("finished")


def check_says_where_a_brake_ends(new):
    server = new()
    server.swing(slower=2.0)
    server.halfway()
    server.command({"type": "brake", "category": 2})
    said = {server.report["rests_at_ns"]} if "rests_at_ns" in server.report else set()
    while server.report["phase"] == "braking":
        if "rests_at_ns" in server.next("feedback") and server.report["phase"] == "braking":
            said.add(server.report["rests_at_ns"])
    rest = server.report["commanded_ns"]
    expect(all(abs(rest - place) < 0.02 * server.motion.duration for place in said), f"said {said}, rests at {rest}")


def check_switches_the_drives_off(new):
    server = new()
    motion = server.swing()
    server.halfway()
    server.command({"type": "brake", "category": 1})
    server.until(lambda said: said["phase"] == "stopped" and not said["drives_on"], "drives that are off")
    server.command(motion.follow(start=server.report["measured_ns"]))
    expect(server.report["drives_on"], "a motion does not switch the drives on")
    server.halfway(0.6)
    server.motion = None  # the arm leaves its path
    server.command({"type": "brake", "category": 0})
    report = server.until(lambda said: said["at_rest"], "a rest")
    expect(not report["drives_on"] and report["phase"] == "fault", "drives are on, or the path was kept")


def check_rejects_what_it_cannot_do(new):
    server = new()
    here = server.phase("idle")["positions"]
    away = Motion(server.arm["joints"], [here[0] + 0.5, *here[1:]])
    report = server.command(away.follow(), "rejected")
    expect(report["phase"] == "fault" and report["detail"], "a rejected motion is no fault, or has no reason")
    server.command({"type": "release"})
    motion = Motion(server.arm["joints"], here)
    server.command(motion.follow(start=motion.duration + 1), "rejected")
    unknown = motion.follow()
    unknown["joints"] = [{**joint, "name": "no_" + joint["name"]} for joint in unknown["joints"]]
    server.command(unknown, "rejected")
    server.swing(slower=2.0)
    server.halfway(0.1)
    server.command({"type": "release"}, "rejected")
    server.command(server.motion.follow(), "rejected")
    server.phase("finished")


def check_brakes_when_the_connection_ends(new):
    server = new()
    motion = server.swing(slower=2.0, authority=None)
    server.halfway(0.2)
    acknowledged, number, session = server.report["authority_ns"], server.number, server.hello["session"]
    server.close()
    time.sleep(0.4 * motion.duration / 1e9)  # without a brake, the arm would still move
    again = new(session=session)
    again.motion, report = motion, again.report
    expect(report["phase"] == "stopped" and report["at_rest"], f"is {report['phase']} after the pause, not stopped")
    expect(report["commanded_ns"] < min(acknowledged, motion.duration), "did not brake")
    expect(report["acknowledged"] == number, "does not continue the numbers of the session")
    again.stays_at_rest()
    again.command(motion.follow(start=again.report["measured_ns"]))
    again.phase("finished")


def check_brakes_without_heartbeats(new):
    server = new()
    server.swing(slower=3.0)
    server.halfway(0.1)
    server.silent = True
    report = server.until(lambda said: said["at_rest"], "a rest")
    expect(report["phase"] == "stopped", f"is {report['phase']}, not stopped")
    server.silent = False
    server.stays_at_rest()


def check_drops_the_motion_of_another_session(new):
    server = new()
    server.swing()
    server.halfway()
    server.close()
    other = new()
    expect(other.report["acknowledged"] == 0, "goes on counting the commands of another session")
    other.phase("idle")
    other.stays_at_rest()


def check_ends_the_connection_after_a_bad_line(new):
    server = new()
    server.swing(slower=2.0)
    server.halfway(0.1)
    server.socket.sendall(b'{"type": "extend", "arm":\n')
    try:
        while True:
            server.next("nothing")
    except (Broken, OSError) as error:
        expect("closed" in str(error) or "refused" in str(error) or isinstance(error, OSError), str(error))
    again = new(session=server.hello["session"])
    again.phase("stopped")


def check_takes_or_rejects_a_speed(new):
    server = new()
    server.number += 1
    server.send({"type": "set_speed", "arm": server.arm["name"], "number": server.number, "share": 0.5})
    report = server.until(lambda said: said["acknowledged"] >= server.number, "an acknowledgement")
    if report["rejected"] == server.number:
        expect(report["detail"], "a rejection has no reason")
        return
    motion = server.swing()
    begin = server.until(lambda said: said["commanded_ns"] > 0.2 * motion.duration, "progress")
    end = server.until(lambda said: said["commanded_ns"] > 0.8 * motion.duration, "progress")
    rate = (end["commanded_ns"] - begin["commanded_ns"]) / (end["time_ns"] - begin["time_ns"])
    expect(rate < 0.55, f"moves at {rate:.2f} of the planned rate, not at 0.5")
    server.phase("finished")
    server.command({"type": "set_speed", "share": 1.0})


CHECKS = {re.sub("^check_", "", name): check for name, check in list(globals().items()) if name.startswith("check_")}


def run(endpoint, hello, names):
    failures = 0
    for name in names:
        opened = []

        def new(opened=opened, **how):
            opened.append(Server(endpoint, hello, **how))
            return opened[-1]

        try:
            CHECKS[name](new)
            print("ok      ", name, flush=True)
        except (Broken, OSError, KeyError, ValueError) as error:
            failures += 1
            print("FAILED  ", name, "-", repr(error) if not isinstance(error, Broken) else error, flush=True)
        for server in opened:
            server.close()
    print(f"{len(names) - failures} passed, {failures} failed")
    return failures


def main():
    parser = argparse.ArgumentParser(description="Tests that a robot driver keeps Armloom's protocol.")
    parser.add_argument("endpoint", help="unix:PATH or tcp:HOST:PORT")
    parser.add_argument("hello", type=pathlib.Path, help="output of `armloom arm --hello`")
    parser.add_argument("--only", nargs="+", choices=list(CHECKS), default=list(CHECKS))
    options = parser.parse_args()
    sys.exit(1 if run(options.endpoint, json.loads(options.hello.read_text()), options.only) else 0)


if __name__ == "__main__":
    main()
