#!/usr/bin/env python3
"""Demo load: both arms shuttle between home and poses in the middle, through the public API.

    server/demo.py URL JOBS_FILE [--parent PID]

Reads motions from a jobs file (config/two_pandas_jobs.json) and submits their ends as goals, so that
the server plans each path from wherever the arm is. Keeps two jobs per arm in the queue, so
that the dashboard shows waiting jobs. Ends with the server, or when the process PID ends.
"""
import json
import os
import sys
import time
import urllib.error
import urllib.request

AHEAD = 2  # jobs per arm that have not ended


class Server:
    def __init__(self, url):
        self.url = url.rstrip("/") + "/api/v1"

    def call(self, method, path, body=None):
        request = urllib.request.Request(
            self.url + path, method=method,
            data=None if body is None else json.dumps(body).encode(),
            headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=10) as answer:
            return json.load(answer)

    def wait_until_up(self, seconds=60):
        for _ in range(seconds * 10):
            try:
                return self.call("GET", "/queue")
            except (urllib.error.URLError, ConnectionError, TimeoutError):
                time.sleep(0.1)
        sys.exit("demo: the server did not come up")


class Shuttle:
    """Sends one arm to the ends of its motions again and again."""

    def __init__(self, server, arm, moves):
        self.server, self.arm, self.moves = server, arm, moves
        self.next = 0

    def keep_busy(self, queue):
        waiting = [job for state in ("queued", "backlog", "scheduled", "running")
                   for job in queue[state] if self.arm in job["arms"]]
        if len(waiting) < AHEAD:
            self.post_one()

    def post_one(self):
        move = self.moves[self.next]
        goal = {"joints": move["trajectory"]["points"][-1]["positions"]}
        job = {"name": move["name"], "arm": self.arm, "move_to": goal}
        try:
            self.server.call("POST", "/jobs", job)
            self.next = (self.next + 1) % len(self.moves)
        except urllib.error.HTTPError as error:
            print(f"demo: {error.code} {error.read().decode()}", file=sys.stderr)
            time.sleep(1)


def moves_of(arm, jobs):
    return [entry["job"] for entry in jobs
            if entry["job"]["trajectory"]["joint_names"][0].startswith(arm + "_")]


def alive(pid):
    return pid is None or os.path.exists(f"/proc/{pid}")


def main():
    if len(sys.argv) not in (3, 5):
        sys.exit(__doc__)
    parent = int(sys.argv[4]) if len(sys.argv) == 5 else None
    with open(sys.argv[2]) as file:
        jobs = json.load(file)
    server = Server(sys.argv[1])
    server.wait_until_up()
    shuttles = [Shuttle(server, arm["name"], moves_of(arm["name"], jobs))
                for arm in server.call("GET", "/arms")["arms"]]
    while alive(parent):
        try:
            queue = server.call("GET", "/queue")
            for shuttle in shuttles:
                if shuttle.moves and not queue["stopped"]:
                    shuttle.keep_busy(queue)
        except (urllib.error.URLError, ConnectionError, TimeoutError):
            if not alive(parent):
                break
        time.sleep(0.2)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:  # Ctrl-C at the terminal ends the server and the demo load
        pass
