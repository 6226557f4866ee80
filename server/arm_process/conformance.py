#!/usr/bin/env python3
"""Tests that a robot driver keeps Armloom's protocol (PROTOCOL.md).

    armloom arm --cell CELL --robot NAME --hello > hello.json
    conformance.py ENDPOINT hello.json [--only CHECK ...]

HAZARD: the first arm of the robot moves its first joint by 0.2 rad from where it is, many times. Keep the space clear.
Prints a line for each check. Exit 0: all passed. Exit 1: a check failed. Exit 2: no hello in the file, or no driver.
"""
import argparse
import copy
import json
import pathlib
import re
import sys
import time

from server_end import Broken, Motion, Server, connect, expect

HELLO = {"type", "protocol", "session", "cell", "robot", "arms", "start_tolerance_rad", "reaction_s", "feedback_period_s",
         "timeout_s"}
JOINT = {"name", "velocity", "acceleration", "brake"}


# ---- Checks. Each begins with a new session; `new(...)` makes a connection. ----

def check_welcome_keeps_the_promises(new):
    server = new()
    expect(server.welcome["robot"] == server.hello["robot"], "another robot answers")
    expect([arm["joints"] for arm in server.welcome["arms"]]
           == [[joint["name"] for joint in arm["joints"]] for arm in server.hello["arms"]], "other joints")
    for promise in ("reaction_s", "feedback_period_s"):
        expect(server.welcome[promise] <= server.hello[promise], f"{promise} is longer than the cell file's")


def expect_refusal(new, pointer, **changes):
    for _ in range(5):
        server = new(welcome=False, **changes)
        place = server.welcome["pointer"]
        server.ends()
        if place == pointer or place != "/session":
            break
        time.sleep(0.2)  # the driver may need a moment to notice the end of the connection before
    expect(place.startswith(pointer) and server.welcome["detail"], f"the error names {place!r}, not {pointer}")


def expect_other_terms_refused(new, change):
    """`change` changes the terms of the last arm."""
    arms = copy.deepcopy(new.hello["arms"])
    change(arms[-1])
    expect_refusal(new, "/arms", arms=arms)


def check_reports_in_time(new):
    server = new()
    times = [server.next("feedback")["time_ns"] for _ in range(101)]
    gaps = sorted(after - before for before, after in zip(times, times[1:]))
    usual = gaps[len(gaps) // 4] / 1e9  # a busy machine delays the others
    expect(usual < 1.5 * server.hello["feedback_period_s"], f"a report every {usual:.4f} s is too few")


def check_refuses_another_version(new):
    expect_refusal(new, "/protocol", protocol=99)


def check_refuses_another_robot(new):
    expect_refusal(new, "/robot", robot="not_" + new.hello["robot"])


def check_refuses_other_arms_or_joints(new):
    expect_other_terms_refused(new, lambda arm: arm.update(name="not_" + arm["name"]))
    expect_refusal(new, "/arms", arms=[*new.hello["arms"], {**new.hello["arms"][0], "name": "one_more"}])
    expect_other_terms_refused(new, lambda arm: arm["joints"][-1].update(name="no_joint"))
    expect_other_terms_refused(new, lambda arm: arm["joints"].pop())


def check_refuses_higher_limits(new):
    for limit in ("velocity", "acceleration", "brake"):
        expect_other_terms_refused(
            new, lambda arm, limit=limit: arm["joints"][-1].update({limit: 2 * arm["joints"][-1][limit]}))


def check_refuses_a_second_server(new):
    first = new()
    expect_refusal(new, "/session")
    first.swing()
    first.phase("finished")


def check_answers_heartbeats_with_its_clock(new):
    server = new()
    first, second = server.deliver(), server.deliver()
    expect(first < second, "its clock stands still")


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
    for number in (server.number, server.number + 2):
        server.send({"type": "extend", "arm": server.arm["name"], "number": number, "authority_ns": motion.duration})
    server.deliver()
    for _ in range(30):
        report = server.next("feedback")
        expect(report["acknowledged"] == server.number, "acknowledged a repeat or a gap")
        expect(report["commanded_ns"] == 0, "obeyed a repeat or a gap")
    server.command({"type": "extend", "authority_ns": motion.duration})
    server.phase("finished")


def check_keeps_the_limits_from_rest_to_rest(new):
    server = new()  # it checks the times between rests
    motion = server.swing(authority=0)
    for share in (0.5, 1.0):
        end = int(share * motion.duration)
        server.command({"type": "extend", "authority_ns": end})
        server.until(lambda said, end=end: said["commanded_ns"] == end and said["at_rest"], "a rest")


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
    motion, _, _ = server.brake_in_motion()
    expect(server.report["at_rest"], "not at rest on its path")
    server.stays_at_rest()
    expect(server.report["drives_on"], "category 2 switches the drives off")
    server.command({"type": "extend", "authority_ns": motion.duration})
    server.stays_at_rest()  # authority does not end a stop
    server.command(motion.follow(start=server.report["measured_ns"]))
    server.phase("finished")


def check_brakes_as_strongly_as_it_promises(new):
    server = new()
    motion, told, rest = server.brake_in_motion()
    before, progress = max((report["time_ns"], report["commanded_ns"]) for report in server.reports
                           if report["time_ns"] <= told)
    free = told - before + 1e9 * (server.welcome["reaction_s"] + server.welcome["feedback_period_s"])
    most = free + 1.1 * max(motion.braking_distance(progress), motion.braking_distance(progress + free))
    expect(rest - progress <= most, f"rests after {(rest - progress) / 1e9:.3f} s of progress, "
                                    f"promised {most / 1e9:.3f} s")


def check_says_where_a_brake_ends(new):
    server = new()
    _, _, rest = server.brake_in_motion()
    said = {report["rests_at_ns"] for report in server.reports
            if report["phase"] == "braking" and "rests_at_ns" in report}
    expect(all(abs(rest - place) < 5_000_000 for place in said), f"said {said}, rests at {rest}")


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
    server.swing(slower=3.0 + 2.0 * server.hello["timeout_s"])
    server.halfway(0.1)
    server.silent = True
    server.until(lambda said: said["at_rest"], "a rest")
    expect(server.report["phase"] == "stopped", f"is {server.report['phase']}, not stopped")
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
    server.ends()
    new(session=server.hello["session"]).phase("stopped")


def check_ends_the_connection_after_a_wrong_message(new):
    server = new()
    follow = Motion(server.arm["joints"], server.report["positions"]).follow()
    extend = {"type": "extend", "authority_ns": 1}
    for wrong in ({"type": "no_type"}, {**extend, "no_member": 1}, {"type": "extend"}, {**extend, "arm": "no_arm"},
                  {**follow, "pieces": [{**piece, "no_member": 1} for piece in follow["pieces"]]}):
        server = new(session=server.hello["session"])
        server.send({"arm": server.arm["name"], "number": server.number + 1, **wrong})
        try:
            server.ends()
        except Broken:
            raise Broken(f"keeps the connection after {wrong}") from None


def check_refuses_a_hello_with_wrong_members(new):
    for hello in ({key: new.hello[key] for key in new.hello if key != "cell"}, {**new.hello, "no_member": 1}):
        server = new(greets=False)
        server.send(hello)
        server.ends()


def check_takes_or_rejects_a_speed(new):
    server = new()
    server.number += 1
    server.send({"type": "set_speed", "arm": server.arm["name"], "number": server.number, "share": 0.5})
    report = server.until(lambda said: said["acknowledged"] >= server.number, "an acknowledgement")
    if report["rejected"] == server.number:
        return expect(report["detail"], "a rejection has no reason")
    server.swing()
    begin, end = server.halfway(0.2), server.halfway(0.8)
    rate = (end["commanded_ns"] - begin["commanded_ns"]) / (end["time_ns"] - begin["time_ns"])
    expect(rate < 0.55, f"moves at {rate:.2f} of the planned rate, not at 0.5")
    for _ in range(10):  # on a busy machine, a command may come too late
        server.command({"type": "set_speed", "share": 1.0})
        server.swing()
        server.halfway()
        server.command({"type": "set_speed", "share": 0.0})
        if server.until(lambda said: said["at_rest"], "a rest")["phase"] == "moving":
            break
    else:
        raise Broken("does not rest on its path at speed 0")
    server.stays_at_rest()
    server.command({"type": "set_speed", "share": 1.0})
    server.phase("finished")


CHECKS = {re.sub("^check_", "", name): check for name, check in list(globals().items()) if name.startswith("check_")}


def run(endpoint, hello, names):
    failures = 0
    for name in names:
        opened = []

        def new(opened=opened, **how):
            opened.append(Server(endpoint, hello, **how))
            return opened[-1]

        new.hello = hello
        try:
            CHECKS[name](new)
            print("ok      ", name, flush=True)
        except (Broken, OSError, KeyError, ValueError) as error:
            failures += 1
            print("FAILED  ", name, "-", repr(error) if not isinstance(error, Broken) else error, flush=True)
        for server in opened:
            server.close()
    print(f"{len(names) - failures} passed, {failures} failed", flush=True)
    return failures


def hello_of(parser, path):
    """Reads the hello. Exits with 2 if it is none."""
    try:
        hello = json.loads(path.read_text())
        if not isinstance(hello, dict) or not HELLO <= set(hello):
            raise ValueError("is no hello")
        if not all(JOINT <= set(joint) for arm in hello["arms"] for joint in arm["joints"]) or not hello["arms"]:
            raise ValueError("has no arms with joints and limits")
        return hello
    except (OSError, ValueError, KeyError, TypeError) as error:
        parser.exit(2, f"{path}: {error}; write the file with `armloom arm --cell CELL --robot NAME --hello`\n")


def main():
    parser = argparse.ArgumentParser(description="Tests that a robot driver keeps Armloom's protocol.")
    parser.add_argument("endpoint", help="unix:PATH or tcp:HOST:PORT")
    parser.add_argument("hello", type=pathlib.Path, help="output of `armloom arm --hello`")
    parser.add_argument("--only", nargs="+", choices=list(CHECKS), default=list(CHECKS))
    options = parser.parse_args()
    hello = hello_of(parser, options.hello)
    try:
        connect(options.endpoint).close()
    except (OSError, ValueError) as error:
        parser.exit(2, f"{options.endpoint}: no connection to a driver: {error}\n")
    sys.exit(1 if run(options.endpoint, hello, options.only) else 0)


if __name__ == "__main__":
    main()
