#!/usr/bin/env python3
"""Demo load: posts the jobs of a file again and again, through the public API.

    server/demo.py URL JOBS_FILE [--parent PID]

Keeps two jobs per arm in the queue, so that the dashboard shows waiting jobs. Jobs with steps are posted as they are. Of
a trajectory, the end is posted as a goal, so that the server plans the path from wherever the arm is. If a job with steps
does not succeed, arms let go of what they hold and go home, the parts are set back to where the cell file has them, and
the jobs begin again. Ends with the server, or when the process PID ends.
"""
import json
import os
import sys
import time
import urllib.error
import urllib.request

AHEAD = 2  # jobs per arm that have not ended
FAILED = ("failed", "expired", "canceled", "interrupted")
ACTIVE = ("queued", "backlog", "scheduled", "running")


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


class Demo:
    def __init__(self, server, jobs):
        self.server = server
        self.arms = [arm["name"] for arm in server.call("GET", "/arms")["arms"]]
        self.jobs = [self.job_of(entry["job"]) for entry in jobs]
        self.has_steps = any("steps" in job for job in self.jobs)
        # By arm: its jobs in the order of the file. A job of several arms stands in several lists.
        self.lists = {arm: [job for job in self.jobs if arm in self.arms_of(job)] for arm in self.arms}
        self.parts = self.places_of_parts()
        self.next = dict.fromkeys(self.arms, 0)
        self.posted = []
        self.is_in_order = not self.has_steps or not server.call("GET", "/scene")["held"]

    def job_of(self, job):
        if "steps" in job:
            return {"name": job["name"], "steps": job["steps"]}
        arm = next(arm for arm in self.arms if job["trajectory"]["joint_names"][0].startswith(arm + "_"))
        return {"name": job["name"], "arm": arm,
                "move_to": {"joints": job["trajectory"]["points"][-1]["positions"]}}

    def arms_of(self, job):
        steps = job.get("steps", [job])
        return {(step.get("gripper") or step).get("arm") for step in steps} - {None}

    def places_of_parts(self):
        carried = {step["attach"]["object"] for job in self.jobs for step in job.get("steps", []) if "attach" in step}
        cell = {each["name"]: each for each in self.server.call("GET", "/cell")["objects"]}
        return {name: cell[name] for name in sorted(carried)}

    def keep_busy(self, queue):
        self.look_at_ends(queue)
        if not self.is_in_order:
            return self.put_in_order(queue)
        active = [job for state in ACTIVE for job in queue[state]]
        waiting = {arm: sum(arm in job["arms"] for job in active) for arm in self.arms}
        for arm in self.arms:
            job = self.turn_of(arm)
            if job and all(self.turn_of(a) is job and waiting[a] < AHEAD for a in self.arms_of(job)):
                return self.post(job)

    def turn_of(self, arm):
        jobs = self.lists[arm]
        return jobs[self.next[arm] % len(jobs)] if jobs else None

    def post(self, job):
        try:
            self.posted.append(self.server.call("POST", "/jobs", job)["id"])
            for arm in self.arms_of(job):
                self.next[arm] += 1
        except urllib.error.HTTPError as error:
            self.complain(error)
            self.is_in_order = not self.has_steps

    def look_at_ends(self, queue):
        """Without success of a job, the parts are not where the next one expects them."""
        active = {job["id"] for state in ACTIVE for job in queue[state]}
        for job in [each for each in self.posted if each not in active]:
            try:
                if self.server.call("GET", f"/jobs/{job}")["state"] in FAILED:
                    self.is_in_order = not self.has_steps
            except urllib.error.HTTPError:
                pass  # forgotten
            self.posted.remove(job)

    def put_in_order(self, queue):
        active = [job["id"] for state in ACTIVE for job in queue[state]]
        mine = [job for job in active if job in self.posted]
        try:
            for job in mine:
                self.server.call("DELETE", f"/jobs/{job}")
            if active:
                return
            for held in self.server.call("GET", "/scene")["held"]:
                self.server.call("POST", f"/scene/objects/{held['object']['name']}/detach")
            away = [arm for arm in self.server.call("GET", "/arms")["arms"]
                    if any(abs(q - home) > 0.02 for q, home in zip(arm["q"], arm["home"]))]
            for arm in away:
                self.server.call("POST", "/jobs", {"name": f"{arm['name']} goes home", "arm": arm["name"],
                                                   "move_to": {"joints": arm["home"]}})
            if away:
                return
            for name, place in self.parts.items():
                body = {key: value for key, value in place.items() if key != "name"}
                self.server.call("PUT", f"/scene/objects/{name}", body)
            self.next = dict.fromkeys(self.arms, 0)
            self.is_in_order = True
        except urllib.error.HTTPError as error:
            self.complain(error)

    def complain(self, error):
        print(f"demo: {error.code} {error.read().decode()}", file=sys.stderr)
        time.sleep(1)


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
    demo = Demo(server, jobs)
    while alive(parent):
        try:
            queue = server.call("GET", "/queue")
            if not queue["stopped"]:
                demo.keep_busy(queue)
        except (urllib.error.URLError, ConnectionError, TimeoutError):
            if not alive(parent):
                break
        time.sleep(0.2)


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:  # Ctrl-C at the terminal ends the server and the demo load
        pass
