"""The server's end of a connection to a driver, as conformance.py needs it: commands, and checks of every report."""
import json
import select
import socket
import time
import uuid

SWING = 0.2  # rad or m
NEAR = 0.0005  # rad or m: a joint this close to a rest has left it late, or has reached it
CLOCK_NS = 2_000_000  # error of time_ns
PATIENCE_S = 20.0  # for an event; a busy machine is slow
MOVING = ("moving", "braking")
ON_PATH = (*MOVING, "stopped", "finished")


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

    def braking_distance(self, start):
        """Returns the longest progress that a brake at the limits may pass from `start` on; the rate there is at most 1."""
        step, at, energy, brake = 1e-3, start / 1e9, 0.5, self.terms[0]["brake"]
        while energy > 0 and at < self.duration / 1e9:
            row = self.rows[0]
            first = abs(sum(k * row[k] * at ** (k - 1) for k in range(1, 6)))
            second = abs(sum(k * (k - 1) * row[k] * at ** (k - 2) for k in range(2, 6)))
            energy -= step * max(brake - second, 0.02 * brake) / max(first, 1e-9)
            at += step
        return at * 1e9 - start

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

    def __init__(self, endpoint, hello, session=None, welcome=True, greets=True, **changes):
        self.hello = {**hello, "session": session or str(uuid.uuid4()), **changes}
        self.arm, self.data, self.report = self.hello["arms"][0], b"", None
        self.motion, self.beat_at, self.number, self.silent = None, 0.0, 0, False
        self.follow_number, self.least_lead, self.reports, self.beats = 0, None, [], {}
        self.rest, self.trace = None, []  # the last rest, and the motion since: times and positions
        self.socket = connect(endpoint)
        if not greets:
            return
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
            expect(message["type"] != "welcome" or kind == "welcome", "the hello was not refused")
            if message["type"] == "heartbeat":
                self.beats[message["time_ns"]] = message["controller_time_ns"]
            if message["type"] == "feedback" and message["arm"] == self.arm["name"]:
                self.check(message)
            if message["type"] == kind and message.get("arm", self.arm["name"]) == self.arm["name"]:
                return message
            if message["type"] == "error":
                raise Refused(f"refused: {message.get('pointer')}: {message.get('detail')}")
        raise Broken(f"no {kind} within {PATIENCE_S} s")

    def ends(self):
        """Waits until the driver closes the connection; it may send an error before."""
        while True:
            try:
                self.next("nothing")
            except Refused:
                pass
            except OSError:
                return
            except Broken as error:
                expect("closed" in str(error), "the driver keeps the connection")
                return

    def check(self, report):
        last, self.report = self.report, report
        expect(len(report["positions"]) == len(self.arm["joints"]), "a report lacks positions")
        if last:
            expect(report["sequence"] > last["sequence"], "sequence does not grow")
            expect(report["time_ns"] >= last["time_ns"], "time_ns runs backwards")
            expect(report["acknowledged"] >= last["acknowledged"], "acknowledged falls")
            if last["phase"] in MOVING and report["phase"] in ON_PATH:
                expect(report["commanded_ns"] >= last["commanded_ns"], "moves backwards on its path")
        expect(report["measured_ns"] <= report["commanded_ns"], "measured progress is ahead of commanded progress")
        if report["phase"] in ON_PATH:
            expect(report["commanded_ns"] <= report["authority_ns"],
                   f"passed its authority: {report['commanded_ns']} > {report['authority_ns']}")
        if self.motion and report["acknowledged"] >= self.follow_number and report["phase"] in ON_PATH:
            self.check_path(report)
        self.check_limits(report)

    def check_path(self, report):
        on_path = [self.motion.at(report[which]) for which in ("measured_ns", "commanded_ns")]
        for joint, position in enumerate(report["positions"]):
            ends = sorted(q[joint] for q in on_path)
            off = max(ends[0] - position, position - ends[1])
            expect(off < 0.02, f"joint {joint} is {off:.4f} off its path")
        self.reports.append(report)
        lead = report["commanded_ns"] - report["time_ns"]
        self.least_lead = lead if self.least_lead is None else min(lead, self.least_lead)
        expect(lead < self.least_lead + CLOCK_NS, "moves faster than planned")

    def check_limits(self, report):
        """Checks the times from rest to a distance d, and back: with acceleration a, each is at least sqrt(2 d / a)."""
        limits, now, q = self.arm["joints"][0], report["time_ns"], report["positions"][0]

        def least_ns(distance, limit):
            return 0.9e9 * ((2 * distance / limit) ** 0.5 - (2 * NEAR / limit) ** 0.5) - CLOCK_NS

        if report["at_rest"]:
            reached, is_near = now, True
            for at, before in reversed(self.trace if self.motion else []):
                is_near = is_near and abs(before - q) <= NEAR
                reached = at if is_near else reached
                expect(reached - at >= least_ns(abs(before - q), limits["brake"]), "brakes harder than the limit")
            self.rest, self.trace = (now, q), []
        elif not self.motion:  # no path, no limits
            self.rest, self.trace = None, []
        else:
            self.trace.append((now, q))
            if self.rest:
                left, begin = self.rest
                if abs(q - begin) <= NEAR:
                    self.rest = now, begin
                expect(now - left >= least_ns(abs(q - begin), limits["acceleration"]),
                       "accelerates harder than the limit")

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
        self.follow_number, self.least_lead, self.reports = self.number + 1, None, []
        self.command(self.motion.follow(**how))
        return self.motion

    def phase(self, *phases):
        return self.until(lambda report: report["phase"] in phases, " or ".join(phases))

    def halfway(self, share=0.3):
        return self.until(lambda report: report["commanded_ns"] > share * self.motion.duration, "progress")

    def deliver(self):
        """Waits until the driver has read all messages."""
        beat = time.monotonic_ns()
        self.send({"type": "heartbeat", "time_ns": beat})
        self.until(lambda report: beat in self.beats, "the answer to a heartbeat")
        return self.beats[beat]

    def brake_in_motion(self):
        """Brakes a motion near its middle. Returns the motion, when the controller read the brake, and where it rests."""
        for _ in range(10):  # on a busy machine, a brake may come too late
            motion = self.swing()
            self.halfway()
            self.number += 1
            self.send({"type": "brake", "category": 2, "arm": self.arm["name"], "number": self.number})
            told = self.deliver()
            rest = self.phase("stopped", "finished")["commanded_ns"]
            passed = max(report["commanded_ns"] for report in self.reports if report["time_ns"] <= told)
            if passed < 0.6 * motion.duration:
                expect(self.report["phase"] == "stopped", "does not brake")
                return motion, told, rest
        raise Broken("the machine is too busy: no brake arrived in time")

    def stays_at_rest(self):
        still = self.report["commanded_ns"], self.report["phase"]
        self.deliver()
        for _ in range(30):
            report = self.next("feedback")
            expect((report["commanded_ns"], report["phase"]) == still, f"moves without a command: {report}")


def connect(endpoint):
    kind, _, place = endpoint.partition(":")
    if kind not in ("unix", "tcp"):
        raise ValueError("not an endpoint: expected unix:PATH or tcp:HOST:PORT")
    if kind == "unix":
        made = socket.socket(socket.AF_UNIX)
        made.connect(place)
        return made
    host, _, port = place.rpartition(":")
    return socket.create_connection((host, int(port)))
