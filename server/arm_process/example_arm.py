"""A simulated arm that keeps PROTOCOL.md and follows its commands exactly. Part of example_driver.py.

To drive a real robot, replace `Arm.positions` by measured positions, and send `Arm.path.positions(Arm.at)` to the robot in
each cycle.
"""
import bisect

GRID_S = 0.005  # step of the table of decelerations
DECELERATION_MAX = 50.0  # of the rate, in 1/s; the path bounds it only where it moves


class Path:
    """A trajectory q(s), with the strongest deceleration of the rate r = ds/dt that the joints permit."""

    def __init__(self, command):
        self.pieces = command["pieces"]
        self.joints = [joint["name"] for joint in command["joints"]]
        self.starts = [0]
        for piece in self.pieces:
            rows = piece["coefficients"]
            if [len(row) for row in rows] != [6] * len(self.joints) or piece["duration_ns"] <= 0:
                raise ValueError("a piece needs a duration and six coefficients per joint")
            self.starts.append(self.starts[-1] + piece["duration_ns"])
        self.duration = self.starts[-1]
        limits = [(joint["acceleration"], joint["brake"]) for joint in command["joints"]]
        steps = max(1, int(self.duration / 1e9 / GRID_S))
        self.grid_ns = self.duration / steps
        found = [self.limits_at(int(k * self.grid_ns), limits) for k in range(steps + 1)]
        self.rises = [min(found[k][0], found[k + 1][0]) for k in range(steps)]
        self.falls = [min(found[k][1], found[k + 1][1]) for k in range(steps)]
        # The integral of the deceleration: a brake from rate r at s ends where it has grown by r^2 / 2.
        self.energy = [0.0]
        for fall in self.falls:
            self.energy.append(self.energy[-1] + fall * self.grid_ns / 1e9)

    def piece_at(self, at):
        number = min(max(bisect.bisect_right(self.starts, at) - 1, 0), len(self.pieces) - 1)
        return self.pieces[number]["coefficients"], (min(at, self.duration) - self.starts[number]) / 1e9

    def positions(self, at):
        rows, t = self.piece_at(at)
        return dict(zip(self.joints, (sum(c * t**k for k, c in enumerate(row)) for row in rows)))

    def limits_at(self, at, limits):
        """The joints permit |q' s'' + q'' r^2| <= limit; returns the bounds of s'' for r <= 1."""
        rows, t = self.piece_at(at)
        rise, fall = DECELERATION_MAX, DECELERATION_MAX
        for row, (acceleration, brake) in zip(rows, limits):
            first = abs(sum(k * row[k] * t ** (k - 1) for k in range(1, 6)))
            second = abs(sum(k * (k - 1) * row[k] * t ** (k - 2) for k in range(2, 6)))
            if first > 1e-9:
                rise = min(rise, max(acceleration - second, 0.02 * acceleration) / first)
                fall = min(fall, max(brake - second, 0.02 * brake) / first)
        return rise, fall

    def cell(self, at):
        return min(int(at / self.grid_ns), len(self.falls) - 1)

    def energy_at(self, at):
        k = self.cell(at)
        return self.energy[k] + self.falls[k] * (at - k * self.grid_ns) / 1e9

    def rest_after(self, at, rate):
        """Returns where a brake from this rate ends."""
        wanted = self.energy_at(at) + rate**2 / 2
        k = min(bisect.bisect_right(self.energy, wanted) - 1, len(self.falls) - 1)
        rest = k * self.grid_ns + (wanted - self.energy[k]) / self.falls[k] * 1e9
        return min(int(rest) + 1, self.duration)


class Arm:
    UNDER_WAY = ("waiting", "moving", "braking")

    def __init__(self, name, joints, positions=None):
        self.name, self.joints, self.tolerance = name, joints, 0.0
        self.positions = list(positions or [0.0] * len(joints))
        self.sequence, self.drives_on, self.share = 0, True, 1.0
        self.begin_session()

    def begin_session(self):
        self.acknowledged, self.rejected, self.detail = 0, 0, ""
        self.drop()

    def drop(self):
        self.path, self.phase, self.rate = None, "idle", 0.0
        self.at = self.authority = 0
        self.switches_off = False

    def obey(self, command):
        if command["number"] != self.acknowledged + 1:
            return  # a repeated command, or one after a gap
        self.acknowledged = command["number"]
        why = getattr(self, command["type"])(command)
        if why:
            self.rejected, self.detail = self.acknowledged, why
            if command["type"] == "follow" and self.phase not in self.UNDER_WAY:
                self.phase = "fault"

    # ---- Commands; each returns why it is rejected ----

    def follow(self, command):
        if self.phase in self.UNDER_WAY:
            return "the arm is in motion"
        try:
            path = Path(command)
        except (ValueError, OverflowError) as error:
            return str(error)
        if not 0 <= command["from_ns"] <= path.duration:
            return f"progress {command['from_ns']} ns is outside the trajectory"
        begins = path.positions(command["from_ns"])
        if not any(joint in begins for joint in self.joints):
            return "the trajectory moves no joint of the arm"
        for joint, position in zip(self.joints, self.positions):
            away = abs(begins.get(joint, position) - position)
            if not away <= self.tolerance:
                return f"{joint} is {away:.6f} from the trajectory"
        self.path, self.phase, self.rate = path, "waiting", 0.0
        self.at, self.authority = command["from_ns"], max(command["authority_ns"], command["from_ns"])
        self.start_at, self.detail, self.drives_on, self.switches_off = command["start_at_ns"], "", True, False

    def extend(self, command):
        if self.path is None:
            return "there is no motion"
        if self.phase in self.UNDER_WAY:
            self.authority = max(command["authority_ns"], self.path.rest_after(self.at, self.rate))

    def brake(self, command):
        category = command["category"]
        if category == 0 and self.phase in ("moving", "braking"):
            self.phase, self.rate, self.drives_on = "fault", 0.0, False
            self.detail = "the drives were switched off in motion"
            return
        self.switches_off = category < 2
        if self.phase == "waiting":
            self.phase = "stopped"
        elif self.phase == "moving" and self.at < self.path.duration:
            self.phase = "braking"
        if self.switches_off and self.phase not in self.UNDER_WAY:
            self.drives_on = False

    def release(self, command):
        if self.phase in self.UNDER_WAY:
            return "the arm is in motion"
        self.drop()

    def set_speed(self, command):
        self.share = command["share"]

    # ---- Each control cycle ----

    def tick(self, now, period_s):
        if self.phase == "waiting" and now >= (self.start_at or 0):
            self.phase = "moving"
            if self.at == 0:  # the path itself begins at rest
                self.rate = min(self.share, self.rate_max(self.at))
        elif self.phase in ("moving", "braking"):
            self.advance(period_s)
        if self.path and self.phase != "fault":
            now_at = self.path.positions(self.at)
            self.positions = [now_at.get(joint, old) for joint, old in zip(self.joints, self.positions)]

    def rate_max(self, at):
        """Returns the largest rate at `at` from which a brake still ends at the authority."""
        if self.authority >= self.path.duration:
            return 1.0  # the path itself ends at rest
        left = self.path.energy_at(self.authority) - self.path.energy_at(at)
        return min(1.0, (2 * max(left, 0.0)) ** 0.5)

    def advance(self, period_s):
        k = self.path.cell(self.at)
        rise, fall = self.path.rises[k] * period_s, self.path.falls[k] * period_s
        wanted = 0.0 if self.phase == "braking" else min(
            self.share, self.rate_max(self.at + self.rate * period_s * 1e9))
        rate = min(max(wanted, self.rate - fall), self.rate + rise)
        end = min(self.authority, self.path.duration)
        step = int((self.rate + rate) / 2 * period_s * 1e9)
        self.at, self.rate = min(self.at + step, end), rate
        if end < self.path.duration and rate <= fall and end - self.at <= rate * period_s * 1e9:
            self.at = end
        if self.at == end:
            self.rate = 0.0
        if self.at == self.path.duration:
            self.phase = "finished"
        elif self.rate == 0.0 and self.phase == "braking":
            self.phase = "stopped"
        if self.switches_off and self.phase not in self.UNDER_WAY:
            self.drives_on = False

    def report(self, now):
        self.sequence += 1
        rests_at = {"rests_at_ns": min(self.path.rest_after(self.at, self.rate), max(self.authority, self.at))
                    } if self.phase == "braking" else {}
        return {"type": "feedback", "arm": self.name, "sequence": self.sequence, "time_ns": now,
                "acknowledged": self.acknowledged, "rejected": self.rejected, "phase": self.phase,
                "commanded_ns": self.at, "measured_ns": self.at, "authority_ns": self.authority, **rests_at,
                "positions": self.positions, "detail": self.detail, "drives_on": self.drives_on,
                "at_rest": self.rate == 0.0 and (self.phase != "moving" or self.at == self.authority or not self.share)}
