#!/usr/bin/env python3
"""An example of a robot driver for Armloom: a simulated robot that follows its commands exactly.

    armloom arm --cell CELL --robot left --hello > left.json
    example_driver.py unix:/tmp/left.sock left.json '{"left": [0, -1.2, 0, -2.6, 0, 1.6, 0.785, 0]}'

The second argument describes the robot: its name, arms, joints and limits. The third argument gives the positions at the
start: for each arm, those of its joints, then of its gripper; without it, all are zero. PROTOCOL.md describes the protocol;
example_arm.py is the simulated arm. Both files need the standard library only.
"""
import json
import os
import pathlib
import select
import socket
import sys
import time

from example_arm import Arm

PROTOCOL = 1
LINE_MAX = 32 << 20
UNSENT_MAX = 1 << 20
CATCH_UP_MAX_S = 0.05  # if a cycle is later, the simulated arm stands still for this time
COMMAND = {"type", "arm", "number"}
MEMBERS = {
    "hello": {"type", "protocol", "session", "cell", "robot", "arms", "start_tolerance_rad", "reaction_s",
              "feedback_period_s", "timeout_s"},
    "heartbeat": {"type", "time_ns"},
    "follow": COMMAND | {"start_at_ns", "from_ns", "authority_ns", "joints", "pieces"},
    "extend": COMMAND | {"authority_ns"},
    "brake": COMMAND | {"category"},
    "release": COMMAND,
    "set_speed": COMMAND | {"share"},
}
ARM, JOINT, PIECE = {"name", "joints"}, {"name", "velocity", "acceleration", "brake"}, {"duration_ns", "coefficients"}
LIMITS = JOINT - {"name"}


def parse(line):
    """Returns the message. Raises ValueError or KeyError if its type, a member, or the lack of a member is an error."""
    message = json.loads(line)
    parts = [(message, MEMBERS[message["type"]])]
    parts += [(arm, ARM) for arm in message.get("arms", [])]
    parts += [(joint, JOINT) for owner in (message, *message.get("arms", [])) for joint in owner.get("joints", [])]
    parts += [(piece, PIECE) for piece in message.get("pieces", [])]
    for part, members in parts:
        if set(part) != members:
            raise ValueError(f"{message['type']} has wrong members: {sorted(set(part) ^ members)}")
    return message


class Peer:
    """A connection that carries lines of JSON."""

    def __init__(self, connection):
        connection.setblocking(False)
        self.socket, self.data, self.unsent, self.since = connection, b"", b"", time.monotonic()

    def messages(self):
        """Returns the messages that have arrived. Raises ConnectionError or ValueError when the connection must end."""
        try:
            while chunk := self.socket.recv(1 << 20):
                self.data += chunk
            raise ConnectionError("the connection was closed")
        except BlockingIOError:
            pass
        if len(self.data) > LINE_MAX:
            raise ValueError("the line is too long")
        *lines, self.data = self.data.split(b"\n")
        return [parse(line) for line in lines]

    def send(self, *messages):
        self.unsent += b"".join(json.dumps(message).encode() + b"\n" for message in messages)
        try:
            self.unsent = self.unsent[self.socket.send(self.unsent):]
        except BlockingIOError:
            pass
        if len(self.unsent) > UNSENT_MAX:
            raise ConnectionError("the server does not read")


class Driver:
    def __init__(self, listening, robot, begins):
        self.listening, self.robot, self.strangers = listening, robot, []
        self.arms = {arm["name"]: Arm(arm["name"], [joint["name"] for joint in arm["joints"]], begins.get(arm["name"]))
                     for arm in robot["arms"]}
        self.server = self.session = None
        self.timeout_s, self.period_s, self.heard_at, self.silent = 1.0, 0.01, 0.0, False

    def run(self):
        due = time.monotonic()
        while True:
            # Before lines are read that arrived while this process was suspended.
            if self.server and not self.silent and time.monotonic() - self.heard_at > self.timeout_s:
                self.silent = True
                self.brake("no heartbeat")
            sockets = [self.listening, *(peer.socket for peer in self.strangers)] + (
                [self.server.socket] if self.server else [])
            ready, _, _ = select.select(sockets, [], [], max(0.0, due - time.monotonic()))
            late_s = time.monotonic() - due
            if self.server and late_s > self.timeout_s:
                self.brake(f"this process was late by {late_s:.3f} s")
            if self.server and self.server.socket in ready:
                self.attempt(self.hear)
            self.greet(ready)
            now = time.monotonic()
            due = max(due, now - CATCH_UP_MAX_S)
            while due <= now:
                self.attempt(lambda due=due: self.cycle(round(due * 1e9)))
                due += self.period_s

    def attempt(self, what):
        try:
            what()
        except (OSError, ValueError, KeyError, TypeError) as error:
            if self.server:
                self.server.socket.close()
            self.server = None
            self.brake(f"the server is gone: {error}")

    def brake(self, why):
        print(why, "- the arms brake", file=sys.stderr, flush=True)
        for arm in self.arms.values():
            arm.brake({"category": 2})

    def greet(self, ready):
        if self.listening in ready:
            self.strangers.append(Peer(self.listening.accept()[0]))
        for peer in list(self.strangers):
            try:
                messages = peer.messages() if peer.socket in ready else []
                if not messages and time.monotonic() - peer.since < 2.0:
                    continue
                self.strangers.remove(peer)
                if messages and messages[0].get("type") == "hello":
                    self.welcome(peer, messages[0])
                else:
                    peer.socket.close()
            except (OSError, ValueError, KeyError, TypeError, AttributeError):
                if peer in self.strangers:
                    self.strangers.remove(peer)
                peer.socket.close()

    def welcome(self, peer, hello):
        def refuse(pointer, detail):
            peer.send({"type": "error", "pointer": pointer, "detail": detail})
            peer.socket.close()

        if hello["protocol"] != PROTOCOL:
            return refuse("/protocol", f"this driver speaks version {PROTOCOL} of the protocol")
        if self.server and hello["session"] != self.session:
            return refuse("/session", "another server is connected")
        for pointer, detail in self.objections(hello):
            return refuse(pointer, detail)
        if self.server:
            self.server.socket.close()
        self.brake("a server connects")
        for arm in self.arms.values():
            arm.tolerance = hello["start_tolerance_rad"]
            if hello["session"] != self.session:
                arm.begin_session()
        self.server, self.session = peer, hello["session"]
        self.timeout_s, self.period_s = hello["timeout_s"], hello["feedback_period_s"]
        self.heard_at, self.silent = time.monotonic(), False
        peer.send({"type": "welcome", "protocol": PROTOCOL, "robot": hello["robot"], "reaction_s": self.period_s,
                   "feedback_period_s": self.period_s,
                   "arms": [{"name": arm.name, "joints": arm.joints} for arm in self.arms.values()]})

    def objections(self, hello):
        """Yields where the hello does not fit the robot, and why."""
        if hello["robot"] != self.robot["robot"]:
            yield "/robot", f"this is robot {self.robot['robot']}"
        names = [[(arm["name"], [joint["name"] for joint in arm["joints"]]) for arm in of["arms"]]
                 for of in (hello, self.robot)]
        if names[0] != names[1]:
            yield "/arms", f"the robot's arms and joints are {names[1]}"
            return
        for a, (asked, own) in enumerate(zip(hello["arms"], self.robot["arms"])):
            for j, (wanted, limits) in enumerate(zip(asked["joints"], own["joints"])):
                if any(wanted[limit] > limits[limit] for limit in LIMITS):
                    yield f"/arms/{a}/joints/{j}", f"the limits of {limits['name']} are {limits}"

    def hear(self):
        for message in self.server.messages():
            self.heard_at, self.silent = time.monotonic(), False
            if message["type"] == "heartbeat":
                self.server.send({**message, "controller_time_ns": time.monotonic_ns()})
            else:
                self.arms[message["arm"]].obey(message)

    def cycle(self, now):
        for arm in self.arms.values():
            arm.tick(now, self.period_s)
        if self.server:
            self.server.send(*(arm.report(now) for arm in self.arms.values()))


def listen(endpoint):
    kind, _, place = endpoint.partition(":")
    if kind not in ("unix", "tcp"):
        raise ValueError("not an endpoint: expected unix:PATH or tcp:HOST:PORT")
    if kind == "unix":
        if pathlib.Path(place).is_socket():  # of a driver that has ended
            os.remove(place)
        listening = socket.socket(socket.AF_UNIX)
        listening.bind(place)
    else:
        host, _, port = place.rpartition(":")
        listening = socket.create_server((host, int(port)))
        endpoint = f"tcp:{host}:{listening.getsockname()[1]}"
    listening.listen()
    print("listens on", endpoint, flush=True)
    return listening


def robot_of(path):
    robot = parse(pathlib.Path(path).read_text())
    if robot["type"] != "hello":
        raise ValueError("not a hello")
    return robot


def begins_of(text, robot):
    """Reads the positions at the start."""
    begins = json.loads(text)
    sizes = {arm["name"]: len(arm["joints"]) for arm in robot["arms"]}
    if not isinstance(begins, dict) or not set(begins) <= set(sizes):
        raise ValueError(f"expected an object with positions of the arms {', '.join(sizes)}")
    for arm, positions in begins.items():
        if not isinstance(positions, list) or len(positions) != sizes[arm] or \
                not all(type(position) in (int, float) for position in positions):
            raise ValueError(f"{arm}: expected a list of {sizes[arm]} numbers")
    return begins


def read(what, reads, *arguments):
    """Returns what `reads` returns. Exits with 2 if the user's input is wrong."""
    try:
        return reads(*arguments)
    except KeyError as error:
        print(f"{what}: {error} is missing or unknown", file=sys.stderr)
    except (OSError, ValueError, TypeError, AttributeError) as error:
        print(f"{what}: {error}", file=sys.stderr)
    sys.exit(2)


def main():
    if len(sys.argv) not in (3, 4):
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    robot = read(sys.argv[2], robot_of, sys.argv[2])
    begins = read("positions at the start", begins_of, sys.argv[3], robot) if len(sys.argv) == 4 else {}
    listening = read(sys.argv[1], listen, sys.argv[1])
    try:
        Driver(listening, robot, begins).run()
    except KeyboardInterrupt:
        pass


if __name__ == "__main__":
    main()
