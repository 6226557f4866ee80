// Written by `npm run contract`: change the descriptions in server/messages, not this file.
export type paths = Record<string, never>;
export type webhooks = Record<string, never>;
export interface components {
    schemas: {
        /** @description A message on WebSocket or SSE. */
        Message: components["schemas"]["SnapshotEvent"] | components["schemas"]["JobEvent"] | components["schemas"]["ArmEvent"] | components["schemas"]["QueueEvent"] | components["schemas"]["SceneEvent"] | components["schemas"]["IoEvent"] | components["schemas"]["MonitorEvent"] | components["schemas"]["GuardEvent"] | components["schemas"]["AlertEvent"] | components["schemas"]["StateFrame"];
        Cell: {
            name: string;
            /** @description Present policy */
            policy: string;
            /** @description Seconds of cell time per second of wall time */
            speed: number;
            /** @description true if every arm is simulated, so that no real drive moves */
            simulated: boolean;
            robots: components["schemas"]["CellRobot"][];
            objects: components["schemas"]["Object"][];
            joints: components["schemas"]["CellJoint"][];
            /** @description Clearance that every admitted motion keeps from other arms and the scene. */
            clearance_m: number;
            /** @description Clearance between links of the same arm; limited to clearance_m. */
            self_clearance_m: number;
            /** @description Clearance between an arm and the link that carries it; limited to clearance_m. Default: clearance_m, because that link may be a table. Set it lower (0.005) if an arm folds onto its own base or works next to its own body. */
            mount_clearance_m?: number;
            /** @description Tolerances of the collision checks. */
            checking: {
                /** @description Time step of the policy timed_discrete. This policy compares motions only at these instants. */
                time_step_s: number;
                /** @description Largest deviation of a joint from its path. All certificates allow for it. */
                tracking_error_rad: number;
                /** @description Expected delay of a motion behind its plan. `validate` warns of controllers with a larger lag_s. Certificates do not depend on this value, because motions are coordinated by measured progress. */
                delay_s: number;
                /** @description Share by which a trajectory may exceed a velocity, acceleration or jerk limit between its waypoints. */
                limit_tolerance: number;
            };
            /** @description Scheduling of jobs. */
            scheduling: {
                /**
                 * @description Policy that decides when jobs start. `armloom compare` simulates your jobs under each policy.
                 * @enum {string}
                 */
                policy: "sequential" | "lockstep" | "reservation" | "timed_discrete" | "certified" | "earliest_start" | "coordinated";
                /** @description Time in the backlog after which a job expires; a job can override it. */
                backlog_timeout_s: number;
                /** @description Waiting time after which a job can no longer be overtaken. */
                aging_s: number;
                /**
                 * @description Action when an idle arm or a deadlock cycle blocks a job. park: move an arm out of the way (retreat). replan: plan another path to the job's end, which loses the rest of its trajectory; if there is no path, park. report: only report the blockade; in a deadlock cycle, the job submitted last fails.
                 * @enum {string}
                 */
                on_idle_blocker: "report" | "park" | "replan";
                /** @description Number of jobs per arm that are scheduled together, including the running one (only for the policy coordinated). The time for a decision grows with the square of this number: above 12, it is tens of milliseconds. */
                horizon_steps: number;
                /**
                 * @description Action after a restart of a server with `--data` if jobs had not ended. ask: all arms stay stopped until they are resumed. continue: jobs that had not begun continue by themselves.
                 * @enum {string}
                 */
                on_restart: "ask" | "continue";
            };
            /** @description Monitoring of the measured state of all arms. */
            monitor: {
                /** @description Rate at which the measured state is checked. */
                rate_hz: number;
                /** @description Time from a finding to the start of braking. */
                reaction_s: number;
                /** @description Clearance below which the monitor stops the arms; at most clearance_m. */
                stop_clearance_m: number;
            };
            /** @description Tolerances for starting and finishing motions; the defaults are MoveIt's. */
            execution: {
                /** @description Largest deviation of an arm from the start of its job. */
                start_tolerance_rad: number;
                /** @description A motion fails as overrun if two conditions hold: it takes longer than its duration times this factor plus duration_margin_s, and it has not moved for 10 s. */
                duration_scaling: number;
                /** @description Margin added to the scaled duration; increase it if arms may stall for longer. */
                duration_margin_s: number;
                /** @description Default velocity scaling of every motion that the server time-parameterizes: goals, `retime`, replans and retreats. A request can override it, as in MoveIt. Trajectories with times run as given. */
                velocity_scaling_factor: number;
            };
        };
        /** @description A job with its present state. */
        Job: {
            id: components["schemas"]["JobId"];
            /** @description Display name; may be empty */
            name: string;
            state: components["schemas"]["JobState"];
            /** @description Arms that the job moves */
            arms: string[];
            /** @description Priority; larger goes first */
            priority: number;
            /** @description Longest time in the backlog; default: the cell's */
            backlog_timeout_s?: number;
            /**
             * @description Action on backlog timeout. `abort`: the job expires. `replan`: the server plans another path from the arm's position to the job's end, around everything at rest. The job expires if there is no such path, and after the third replan
             * @enum {string}
             */
            on_timeout?: "abort" | "replan";
            /**
             * @description `plan`: the arms need not be at the start of the trajectory. The server first moves each arm there slowly, on a planned path
             * @enum {string}
             */
            move_to_start?: "none" | "plan";
            /** @description true: the scheduler may reorder this job among reorderable jobs of the same arm that begin and end at the same configuration */
            reorderable?: boolean;
            /** @description The job does not start while the signal has another value. It keeps its place in the queue of its arm */
            start_when?: {
                /** @description Name of the input or output */
                io: string;
                /** @description Value at which the job starts */
                value: boolean | number;
            };
            /** @description Time of acceptance, in cell time */
            submitted_s: number;
            /**
             * Format: date-time
             * @description The same in wall time
             */
            submitted_at: string;
            /** @description Cell time of the first conflict; absent if there was none */
            backlogged_s?: number;
            /** @description Cell time at which the job expires if nothing changes. Present while the job waits in the backlog, or waits on its path for something that no job moves */
            expires_s?: number;
            /** @description Scheduled start; null if not scheduled, in cell time */
            scheduled_s: number | null;
            /**
             * Format: date-time
             * @description The same in wall time
             */
            scheduled_at: string | null;
            /** @description Start of motion; null before it, in cell time */
            started_s: number | null;
            /**
             * Format: date-time
             * @description The same in wall time
             */
            started_at: string | null;
            /** @description End; null before it, in cell time */
            ended_s: number | null;
            /**
             * Format: date-time
             * @description The same in wall time
             */
            ended_at: string | null;
            /** @description Share of the trajectory's time, 0 to 1 */
            progress: number;
            /** @description Duration of the trajectory, velocity scaling included */
            duration_s: number;
            /** @description true if `duration_s` is an estimate, because the path to the goal is not planned yet: the straight line in joint space at this velocity scaling */
            duration_is_estimate?: boolean;
            /** @description For a goal: share of the maximum velocity */
            velocity_scaling_factor?: number;
            /** @description For a goal: true if the path is planned */
            planned?: boolean;
            /** @description true if the server computed the times of the trajectory (`retime`) */
            retimed?: boolean;
            /** @description true while the job brakes on its path */
            stopping: boolean;
            /** @description Only of a job with steps */
            steps?: components["schemas"]["Step"][];
            /** @description Only of a job with steps: index of the present step */
            step?: number;
            /** @description Reasons to wait; empty if the job does not wait. Of a job that has expired: what it waited for */
            waits_on: components["schemas"]["Wait"][];
            /** @description Candidate arms; `arms` has the selected arm, or the most likely one while the job waits */
            alternatives?: string[];
            /** @description Replans of the job */
            replan?: {
                /** @description Number of successful replans */
                done: number;
                /** @description true while a path is being planned; the arm waits on its path */
                planning: boolean;
                /**
                 * @description Cause of the last replan: POST /jobs/{id}/replan, on_timeout, or on_idle_blocker
                 * @enum {string}
                 */
                cause: "client" | "timeout" | "blocked";
                /** @description Reason why the last replan failed and the job kept its path; else null */
                refused: string | null;
            };
            /** @description Present for a goal whose shortest path would have to wait: detours around the motions of other arms */
            detour?: {
                /** @description Number of detours evaluated */
                candidates_evaluated: number;
                /** @description true if the job takes a detour */
                selected: boolean;
                /** @description Time by which the detour is predicted to arrive earlier. null if no detour is selected, or if the shortest path was blocked */
                time_saved_s: number | null;
            };
            /** @description Why this job went before others, or why this arm was selected */
            choice?: {
                /** @description Jobs that could have gone first, or arms that could have done the job, when the choice was first made */
                candidates: string[];
                /** @description The selected candidate */
                selected: string;
                /** @description Time saved compared with the first candidate: lower plan cost, or for a goal earlier arrival. null if the first candidate is selected or could not go */
                time_saved_s: number | null;
                detail: string;
            };
            /** @description Present if the job starves: it has waited longer than `aging_s` while jobs that were submitted later went first */
            starvation?: {
                /** @description Cell time since which the job is the first of its arms and was not admitted */
                waits_since_s: number;
                /** @description `aging_s` of the cell: the job is flagged if it is overtaken after this time */
                bound_s: number;
                /** @description Number of jobs, submitted later, that were admitted since then */
                overtaken_by: number;
            };
            /** @description Ids of the jobs in the deadlock cycle that contains this job, this job first. Each job waits for the next, and the last for the first. Empty if the job is in no cycle */
            cycle: string[];
            /** @description Result of an ended job; else null */
            result: {
                reason: components["schemas"]["Reason"];
                detail: string;
                /** @description Of a job with steps that did not succeed: index of the step at which it ended */
                step?: number;
            } | null;
            /** @description Only in the answer to PATCH: why the change has no effect at present */
            notice?: string;
        };
        /** @description The coordination diagram of two motions. The times of cells and of progress are trajectory time. */
        Diagram: {
            /** @description Cell time of `state` and `progress_s` */
            t_s: number;
            a: components["schemas"]["DiagramSide"];
            b: components["schemas"]["DiagramSide"];
            /** @description One layer for each pair of different arms of A and B */
            layers: {
                /** @description The arm of A and the arm of B */
                arms: [
                    string,
                    string
                ];
                /** @description Cells that cover the rectangle of both durations without overlapping each other; absent with `cells=0` */
                cells?: components["schemas"]["DiagramCell"][];
                /** @description What the motions reach first if both continue from their present progress and each rests at its end: the first conflict, or else the first undecided cell. null if only free cells follow */
                first_contact: components["schemas"]["DiagramContact"] | null;
            }[];
            evaluations: number;
            scene_version: number;
        };
        /** @description Predicted motions. Times are cell time unless noted otherwise. */
        Timeline: {
            now_s: number;
            /** @description Maximum number of admitted motions per arm, the running one included */
            horizon_steps: number;
            /** @description Arms in the order of the cell */
            arms: components["schemas"]["TimelineArm"][];
        };
        /** @description Problem document (RFC 9457). */
        Problem: {
            type: string;
            title: string;
            status: number;
            /** @description One sentence with the values found and their units */
            detail: string;
            /** @description JSON pointer into the body, or the place in words */
            pointer?: string;
            /** @description Value found there */
            value?: string | number | null;
            /** @description All faults, if there are several */
            errors?: {
                pointer: string;
                detail: string;
                /** @description Value found there */
                value: string | number | null;
            }[];
            /** @description If planning failed: the two links that come too close, or the link that misses its pose */
            links?: string[];
            /** @description Distance of the two links; zero or negative in contact */
            clearance_m?: number;
            /** @description Distance that the two links must keep */
            required_clearance_m?: number;
            /** @description Usable joint positions nearest to the request: the nearest collision-free ones; for an unreachable pose, the closest to the pose; for a straight line, the farthest point on the line */
            nearest?: number[];
            /** @description Evaluations that planning took */
            evaluations?: number;
            /** @description If a step of a job cannot be planned: the steps before it */
            steps?: components["schemas"]["PlannedStep"][];
        };
        /** @description The result of checking a job as if it were submitted now. */
        Verdict: {
            /** @enum {string} */
            verdict: "free" | "conflict" | "undecided";
            /** @description Delay until the earliest start; 0 for an immediate start, null if unknown */
            earliest_start_s: number | null;
            /** @description Certified clearance between arms, and between arms and objects: the smallest clearance required of any such pair */
            clearance_bound_m: number | null;
            /** @description Certified clearance between links of one arm */
            self_clearance_bound_m: number | null;
            /** @description What the job would wait for; a job with verdict `free` may still wait before it starts */
            waits_on: components["schemas"]["Wait"][];
            /** @description Conflicts found, in the form of `waits_on`; empty if `verdict` is `free` */
            conflicts: components["schemas"]["Wait"][];
            evaluations: number;
            scene_version: number;
            /** @description For a goal with several candidate arms: the arm that would be selected */
            choice?: {
                /** @description Jobs that could have gone first, or arms that could have done the job, when the choice was first made */
                candidates: string[];
                /** @description The selected candidate */
                selected: string;
                /** @description Time saved compared with the first candidate: lower plan cost, or for a goal earlier arrival. null if the first candidate is selected or could not go */
                time_saved_s: number | null;
                detail: string;
            };
            /** @description For a job with `move_to_start`: duration of the motion to its start. The verdict covers that motion. If the job cannot be admitted together with that motion, it is checked again at its start */
            move_to_start_s?: number;
            /** @description Result of a job that would end at once without moving. Of a job with steps: its result if it would end before the motion of `step` */
            result?: {
                reason: components["schemas"]["Reason"];
                detail: string;
                /** @description Of a job with steps that did not succeed: index of the step at which it ended */
                step?: number;
            };
            /** @description Only of a job with steps that is not `free`: index of the first step that is not. `verdict`, `waits_on`, `conflicts` and `result` are those of this step */
            step?: number;
        };
        /** @description The motion of a job. */
        JobMotion: {
            /** @description Id of the job */
            id: components["schemas"]["JobId"];
            duration_s: number;
            /** @description The trajectory in the form of POST /jobs; submitting it gives the same motion */
            trajectory: components["schemas"]["JointTrajectory"];
        };
        /** @description A planned motion, not executed. */
        Plan: {
            /** @description Arm that moves */
            arm: string;
            /** @description The other candidate arms: when each would arrive, or why it cannot */
            others: {
                arm: string;
                /** @description Time until arrival, from now; null if the arm has no path or its start time is unknown */
                arrives_s: number | null;
                detail: string;
            }[];
            /** @description The trajectory in the form of POST /jobs */
            trajectory: components["schemas"]["JointTrajectory"];
            duration_s: number;
            /** @description Length of the path in joint space, rad or m */
            length: number;
            /** @description Length of the straight line to the goal in joint space */
            straight_line_length: number;
            /** @description Line segments checked by the search */
            evaluations: number;
            /** @description Result of POST /check for this motion now */
            verdict?: components["schemas"]["Verdict"];
            /** @description Instead of `verdict`: why POST /jobs would refuse this motion now */
            not_checked_reason?: components["schemas"]["Problem"];
        };
        AlertList: {
            /** @description Newest first */
            alerts: components["schemas"]["KeptAlert"][];
        };
        /** @description The caller and its role. */
        Session: {
            /** @description true if the server requires a token; false if every request is allowed */
            auth_required: boolean;
            /** @description Name of the token; null if there is none */
            name: string | null;
            /** @description Role of the caller; null if it may only log in */
            role: ("viewer" | "operator" | "admin") | null;
        };
        /** @description Simulations of the same jobs under several policies. */
        Comparison: {
            /** @enum {string} */
            state: "running" | "done" | "canceled" | "failed";
            /** @description Number of compared jobs */
            jobs: number;
            /** @description Submission time of the first job */
            first_s: number;
            /** @description Submission time of the last job */
            last_s: number;
            /** @description The server's policy when the comparison was requested */
            in_force: string;
            /** @description Compared policies, in the order of `runs` */
            policies: string[];
            /** @description Finished simulations */
            runs: components["schemas"]["PolicyRun"][];
            /** @description Reason of the failure; empty otherwise */
            detail: string;
        };
        /** @description The client that may jog arms; one client at a time. */
        Control: {
            /** @description null if no client has control */
            holder: components["schemas"]["ControlHolder"] | null;
        };
        ControlTaken: {
            holder: components["schemas"]["ControlHolder"] | null;
            /** @description Secret, required by every jog request; returned only here */
            key?: string;
        };
        /** @description A jog motion in its present state. */
        Jog: {
            job: components["schemas"]["Job"];
            /** @description The arm brakes if no renewal arrives for this long (wall time) */
            lease_s: number;
        };
        JobPage: {
            jobs: components["schemas"]["Job"][];
            /** @description Value for `?cursor=` to get the next page; null on the last page */
            next_cursor: string | null;
        };
        MeasuredStates: {
            /** @description UUID of the server session, as in events */
            stream: string;
            /** @description Names of all joints of the cell */
            joints: string[];
            /** @description Cell times of the samples, ascending */
            t_s: number[];
            /** @description Positions at each time, in the order of `joints`: rad or m */
            q: number[][];
        };
        RecordingList: {
            /** @description true if this server records (`--data`) */
            kept: boolean;
            /** @description Newest first */
            recordings: components["schemas"]["Recording"][];
        };
        Fault: {
            id: string;
            arm: string;
            /** @enum {string} */
            kind: "stall" | "slow" | "late_start" | "fault" | "drop_feedback" | "freeze_feedback" | "drift" | "reject" | "runaway" | "ignore_stop" | "noise" | "delay" | "jitter" | "loss" | "reorder" | "cut" | "restart" | "clock_drift";
            /** @description Start in cell time; null if the fault begins at once */
            at_s: number | null;
            /** @description Duration; null if the fault lasts until it is removed (`fault` and `reject`: until it has occurred) */
            for_s: number | null;
            value: number;
        };
        /** @description A fault of a simulated arm, or of the link to its controller. `stall`: the arm stays where it is on its path. `slow`: the arm follows its path at a share of its speed. `late_start`: the arm begins each motion late. `fault`: the controller fails once, from `at_s` on: during the present motion, or else as soon as the next motion moves. `drop_feedback`: no report of the arm arrives. `freeze_feedback`: reports arrive with new numbers and times, but with old content. `drift`: the first joint leaves its path, or the position where it rests, until the arm is braked. The joint stays off its path until the next motion. `reject`: the controller rejects the next motion, once. `runaway`: the arm passes its authority and goes on to the end of its trajectory: it may hit other arms. `ignore_stop`: the controller acknowledges brakes, but carries them out only when the fault ends. Only a stop of category 0 works. `noise`: measured positions have Gaussian noise. `delay`: commands and reports arrive late. `jitter`: commands and reports arrive late by random times. `loss`: commands and reports are lost at random. `reorder`: commands and reports are overtaken by later ones at random. `cut`: the connection is down, and messages under way are lost. The arm brakes by itself. `restart`: the controller is down, and forgets its motion. The arm brakes by itself. `clock_drift`: the controller's clock is too fast, or too slow if the value is negative. */
        FaultRequest: {
            /** @description Arm that gets the fault */
            arm: string;
            /**
             * @description Kind of fault
             * @enum {string}
             */
            kind: "stall" | "slow" | "late_start" | "fault" | "drop_feedback" | "freeze_feedback" | "drift" | "reject" | "runaway" | "ignore_stop" | "noise" | "delay" | "jitter" | "loss" | "reorder" | "cut" | "restart" | "clock_drift";
            /** @description Start in cell time; default: now */
            at_s?: number;
            /** @description Duration; by default, the fault lasts until it is removed. Not allowed for `fault` and `reject`, which occur once */
            for_s?: number;
            /** @description `slow`: share of the speed, at least 0 and at most 1; `late_start`: delay in s, at least 0 and at most 1e+06; `drift`: rad/s or m/s, at least -10 and at most 10, default 0.1; `noise`: standard deviation in rad or m, at least 0 and at most 1, default 0.01; `delay`: delay of each message in s, at least 0 and at most 10, default 0.05; `jitter`: largest delay of a message in s, at least 0 and at most 10, default 0.02; `loss`: probability for each message, at least 0 and at most 1, default 0.1; `reorder`: probability for each message, at least 0 and at most 1, default 0.1; `clock_drift`: seconds gained in each second, at least -0.1 and at most 0.1, default 5e-04. Not allowed for other kinds */
            value?: number;
        } & (unknown & unknown & unknown & unknown & unknown & unknown & unknown & unknown & unknown & unknown & unknown & unknown & unknown & unknown & unknown & unknown & unknown & unknown);
        SnapshotEvent: {
            /**
             * Format: uuid
             * @description UUID of this server session
             */
            stream: string;
            /** @description Number of the event; consecutive within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "snapshot";
            /** @description Cell time of the event */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time of the event
             */
            at: string;
            data: components["schemas"]["Snapshot"];
        };
        JobEvent: {
            /**
             * Format: uuid
             * @description UUID of this server session
             */
            stream: string;
            /** @description Number of the event; consecutive within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "job";
            /** @description Cell time of the event */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time of the event
             */
            at: string;
            data: components["schemas"]["Job"];
        };
        ArmEvent: {
            /**
             * Format: uuid
             * @description UUID of this server session
             */
            stream: string;
            /** @description Number of the event; consecutive within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "arm";
            /** @description Cell time of the event */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time of the event
             */
            at: string;
            data: components["schemas"]["Arm"];
        };
        QueueEvent: {
            /**
             * Format: uuid
             * @description UUID of this server session
             */
            stream: string;
            /** @description Number of the event; consecutive within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "queue";
            /** @description Cell time of the event */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time of the event
             */
            at: string;
            data: components["schemas"]["QueueIds"];
        };
        SceneEvent: {
            /**
             * Format: uuid
             * @description UUID of this server session
             */
            stream: string;
            /** @description Number of the event; consecutive within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "scene";
            /** @description Cell time of the event */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time of the event
             */
            at: string;
            data: components["schemas"]["Scene"];
        };
        IoEvent: {
            /**
             * Format: uuid
             * @description UUID of this server session
             */
            stream: string;
            /** @description Number of the event; consecutive within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "io";
            /** @description Cell time of the event */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time of the event
             */
            at: string;
            data: components["schemas"]["Signal"];
        };
        MonitorEvent: {
            /**
             * Format: uuid
             * @description UUID of this server session
             */
            stream: string;
            /** @description Number of the event; consecutive within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "monitor";
            /** @description Cell time of the event */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time of the event
             */
            at: string;
            data: components["schemas"]["MonitorFinding"];
        };
        GuardEvent: {
            /**
             * Format: uuid
             * @description UUID of this server session
             */
            stream: string;
            /** @description Number of the event; consecutive within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "guard";
            /** @description Cell time of the event */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time of the event
             */
            at: string;
            data: components["schemas"]["GuardFinding"];
        };
        AlertEvent: {
            /**
             * Format: uuid
             * @description UUID of this server session
             */
            stream: string;
            /** @description Number of the event; consecutive within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "alert";
            /** @description Cell time of the event */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time of the event
             */
            at: string;
            data: components["schemas"]["Alert"];
        };
        /** @description Measured positions at about 30 Hz of wall time; dropped for slow subscribers. */
        StateFrame: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "state";
            t_s: number;
            /** @description Position of every joint of the cell, by name: rad or m */
            q: {
                [key: string]: number;
            };
            clearance: {
                /** @description Names of two arms; or of one arm, if the other body is an object or a link that no arm moves */
                arms: string[];
                m: number;
                links: [
                    string,
                    string
                ];
            }[];
            /** @description One entry for each arm that has a motion */
            motions: components["schemas"]["ArmAuthority"][];
            /** @description Seconds of cell time per second of wall time */
            speed: number;
        };
        CellRobot: {
            name: string;
            prefix: string;
            base: {
                /** @description Position, in meters. */
                xyz: [
                    number,
                    number,
                    number
                ];
                /** @description Roll, pitch, yaw about fixed axes, in radians, as in a URDF. */
                rpy: [
                    number,
                    number,
                    number
                ];
            };
            /** @description Text of the URDF; names without the prefix */
            urdf: string;
            /** @description Text of the SRDF */
            srdf: string;
            /** @description Path of each mesh file, by the name that the URDF uses */
            meshes: {
                [key: string]: string;
            };
            controller: components["schemas"]["CellController"];
            arms: components["schemas"]["CellArm"][];
        };
        /** @description An object of the scene, with exactly one shape. A mesh is given by its path on this server. */
        Object: {
            /** @description Name of the object; unique in the cell, and not the name of a link or robot. */
            name: string;
            /** @description A box: full side lengths, in meters. */
            box?: [
                number,
                number,
                number
            ];
            /** @description A cylinder along z: radius and full length, in meters. */
            cylinder?: [
                number,
                number
            ];
            /** @description A sphere: radius, in meters. */
            sphere?: [
                number
            ];
            /** @description A mesh: path of an STL, OBJ or DAE file. Everything that the mesh encloses is treated as solid, cavities included. */
            mesh?: string;
            /** @description Scale factors of a mesh along x, y and z. */
            scale?: [
                number,
                number,
                number
            ];
            /** @description Position, in meters. */
            xyz: [
                number,
                number,
                number
            ];
            /** @description Roll, pitch, yaw about fixed axes, in radians, as in a URDF. */
            rpy: [
                number,
                number,
                number
            ];
            /** @description Mass, in kilograms. An arm that holds the object moves slower (`payload` of the arm). Default: light enough not to matter. */
            mass_kg?: number;
            /** @description Center of mass in the object's frame, in meters. */
            center_of_mass_m?: [
                number,
                number,
                number
            ];
        } & (unknown | unknown | unknown | unknown);
        CellJoint: {
            name: string;
            /** @description Arm of the joint; null if no arm has it */
            arm: string | null;
            /** @description null if the joint has no such limit */
            lower: number | null;
            /** @description null if the joint has no such limit */
            upper: number | null;
            velocity_max: number;
            acceleration_max: number;
            jerk_max: number;
            brake: number;
            /** @enum {string} */
            unit: "rad" | "m";
        };
        /** @description Id of a job, chosen by the client or the server. */
        JobId: string;
        /**
         * @description State of a job. The last five states are terminal; every job reaches exactly one of them.
         * @enum {string}
         */
        JobState: "queued" | "backlogged" | "scheduled" | "running" | "paused" | "succeeded" | "canceled" | "expired" | "failed" | "interrupted";
        /** @description A step of a job. */
        Step: {
            /** @description Display name; may be empty */
            name: string;
            /** @description The member that names the step: trajectory, move_to, gripper, attach, detach, wait_s, set_io or wait_io */
            kind: string;
            /** @enum {string} */
            state: "waiting" | "running" | "done" | "failed";
            /** @description What the step does; may be empty */
            detail: string;
            /** @description Arms that a motion moves */
            arms: string[];
            /** @description Progress of a motion */
            progress: number;
        };
        /** @description A reason to wait, with the evidence. */
        Wait: {
            /** @enum {string} */
            kind: "job" | "arm" | "object" | "predecessor" | "capacity" | "stop" | "plan" | "check" | "guard" | "speed" | "io" | "action" | "holding";
            /** @description Id of the other job; for kind io the name of the signal */
            id: string | null;
            /** @description Name of the other arm */
            arm: string | null;
            /** @description Link of this job's arm, then the other link or object; empty without evidence */
            links: string[];
            /** @description Time of the conflict from the start of this trajectory. For kind predecessor the end of the trajectory, if this job would end in the path of that job */
            own_time_s: number | null;
            /** @description Time of the conflict from the start of the other trajectory */
            other_time_s: number | null;
            /** @description Distance found; zero or negative in contact */
            clearance_m: number | null;
            /** @description Details, for example the cause of a stop, or why a predecessor goes first */
            detail?: string;
            /** @description While the job is being checked: share of the limit of evaluations used so far. Most checks end before the limit */
            progress?: number;
        };
        /**
         * @description Why a job ended. core/scheduler/README.md explains each reason.
         * @enum {string}
         */
        Reason: "completed" | "canceled_by_client" | "backlog_timeout" | "start_mismatch" | "self_collision" | "predecessor_failed" | "arm_fault" | "overrun" | "server_restart" | "deadlock" | "step_failed" | "no_plan";
        DiagramSide: {
            id: components["schemas"]["JobId"];
            state: components["schemas"]["JobState"];
            duration_s: number;
            progress_s: number;
        };
        DiagramCell: {
            /**
             * @description `free`: every state of the cell keeps the clearance; `conflict`: no state keeps the clearance; `undecided`: only some states keep the clearance, or nothing is proven
             * @enum {string}
             */
            state: "free" | "conflict" | "undecided";
            /** @description Interval [from, to] */
            a_s: [
                number,
                number
            ];
            /** @description Interval [from, to] */
            b_s: [
                number,
                number
            ];
        };
        DiagramContact: {
            /** @enum {string} */
            state: "free" | "conflict" | "undecided";
            /** @description Time until the contact, from `t_s` on */
            in_s: number;
            a_s: number;
            b_s: number;
        };
        TimelineArm: {
            /** @description Name of the arm */
            name: string;
            /** @description Admitted motions in order */
            steps: components["schemas"]["TimelineStep"][];
            /** @description Number of jobs of the arm that have not ended and are not in `steps`. They are not admitted yet, so they have no times */
            waiting: number;
        };
        /** @description A step of a job that is planned, but not executed. */
        PlannedStep: {
            /** @description Display name; may be empty */
            name: string;
            /** @description The member that names the step, as in `Step` */
            kind: string;
            /** @description What the step does; may be empty */
            detail: string;
            /** @description Arms that a motion moves */
            arms: string[];
            /** @description Only of a motion: its trajectory in the form of POST /jobs */
            trajectory?: components["schemas"]["JointTrajectory"];
            /** @description Only of a motion */
            duration_s?: number;
            /** @description Line segments checked by the search */
            evaluations: number;
        };
        /** @description A trajectory in the form of trajectory_msgs/JointTrajectory. */
        JointTrajectory: {
            /** @description Names of the joints: prefix + URDF name. Joints of several arms make one synchronous motion. If of an arm only gripper joints are named, it stays */
            joint_names: string[];
            /** @description Waypoints. A single waypoint is approached from where the arm will be */
            points: components["schemas"]["Waypoint"][];
            header?: {
                /** @description Must be 0 */
                stamp?: 0 | {
                    /** @constant */
                    sec: 0;
                    /** @constant */
                    nanosec: 0;
                } | {
                    /** @constant */
                    secs: 0;
                    /** @constant */
                    nsecs: 0;
                };
                /** @description Ignored: joint positions have no frame */
                frame_id?: string;
                /** @description Ignored */
                seq?: number;
            };
        };
        /** @description A warning or error, kept until it is acknowledged. */
        KeptAlert: {
            /** @description `<stream>:<seq>` of the event that reported the alert */
            id: string;
            /** @description RFC 3339, UTC */
            at: string;
            /** @description `warning` or `error` */
            level: string;
            text: string;
            /** @description null while nobody has acknowledged the alert */
            acknowledged: components["schemas"]["Acknowledgement"] | null;
        };
        /** @description Simulated outcome of the jobs under one policy. */
        PolicyRun: {
            policy: string;
            succeeded: number;
            expired: number;
            failed: number;
            /** @description Jobs canceled by the server, interrupted jobs included */
            canceled: number;
            /** @description Jobs refused on submission, because the job would not begin where its arm would be */
            refused: number;
            /** @description Jobs that had not ended when nothing could move any more, or when the simulation was given up */
            unfinished: number;
            /** @description Jobs that waited in the backlog at least once */
            backlogged: number;
            /** @description Time from the first submission to the last end; null if a job did not end or no job started */
            makespan_s: number | null;
            /** @description `makespan_s` divided by that of `sequential`; null if unknown */
            makespan_ratio: number | null;
            /** @description Mean time from submission to start */
            wait_mean_s: number;
            wait_max_s: number;
            /** @description Smallest clearance that the monitor measured; null if no pair came close */
            min_clearance_m: number | null;
            monitor_stops: number;
            /** @description Number of state checks that the decisions of the policy took */
            evaluations: number;
            /** @description true if the simulation exceeded its limit of evaluations; the results then cover only the time before */
            given_up: boolean;
        };
        ControlHolder: {
            who: string;
            /** @description RFC 3339, UTC */
            since_at: string;
            /** @description The arm that the holder jogged last */
            arm: string | null;
            /** @description The job of that jog */
            job: components["schemas"]["JobId"] | null;
        };
        /** @description Recording of one server session. */
        Recording: {
            /** @description Name of the folder; `data` if the recording is in the data folder itself */
            name: string;
            /** @description Start of the session: RFC 3339, UTC; null if unknown */
            begun_at: string | null;
            /** @description Last write: RFC 3339, UTC */
            written_at: string;
            /** @description true while the recording is being written */
            running: boolean;
            /** @description true if the recording has joint positions (`serve --record`) */
            has_states: boolean;
            /** @description Files that GET returns */
            files: components["schemas"]["RecordingFile"][];
        };
        Snapshot: {
            cell: string;
            policy: string;
            speed: number;
            stopped: boolean;
            /** @description Speed override of the cell; absent in old recordings */
            speed_override?: number;
            arms: components["schemas"]["Arm"][];
            /** @description All jobs that have not ended, and the 200 that ended last */
            jobs: components["schemas"]["Job"][];
            queue: components["schemas"]["QueueIds"];
            objects: components["schemas"]["Object"][];
            /** @description Objects that arms hold, if there are any */
            held?: components["schemas"]["HeldObject"][];
            /** @description Inputs and outputs, if the cell has any */
            io?: components["schemas"]["Signal"][];
            /** @description true if events before this snapshot were lost */
            gap?: boolean;
        };
        Arm: {
            name: string;
            robot: string;
            state: components["schemas"]["ArmState"];
            /** @description Id of the job that the arm executes, moving or paused; null if none */
            job: string | null;
            progress: number;
            joints: string[];
            /** @description Measured joint positions in the order of `joints`: rad or m */
            q: number[];
            home: number[];
            /** @description Largest measured deviation of a joint from the path */
            deviation_rad: number;
            /** @description Largest `deviation_rad` since the session began */
            deviation_max_rad: number;
            /**
             * @description Link to the arm's controller. connecting: no report yet. stale: reports are late, and the arm gets no more authority. lost: the arm is stopped until it is resumed
             * @enum {string}
             */
            link: "connecting" | "up" | "stale" | "lost";
            /** @description Why the link is not up; null if it is */
            link_detail: string | null;
            /** @description False after a stop of category 0 or 1, until the arm's next motion */
            drives_on: boolean;
            /** @description Why the arm is stopped until it is resumed; null if it is not stopped */
            stop_cause: string | null;
            /** @description Speed override of this arm: largest share of the planned speed; absent in old recordings */
            speed_override?: number;
            /** @description Override at which the arm moves: cell's override x this arm's x what its payload leaves. The arms of one motion all move at the smallest of theirs */
            effective_speed_override?: number;
        };
        QueueIds: {
            /** @description Present policy; absent in old recordings */
            policy?: string;
            /** @description true if every arm is stopped */
            stopped: boolean;
            /** @description Speed override of the cell; absent in old recordings */
            speed_override?: number;
            queued: string[];
            backlog: string[];
            scheduled: string[];
            running: string[];
        };
        Scene: {
            /** @description Version of the scene; grows with every change */
            version: number;
            objects: components["schemas"]["Object"][];
            /** @description Objects that arms hold; they are not in `objects` */
            held: components["schemas"]["HeldObject"][];
            /** @description Contact with objects that steps of jobs allow at present; absent if there is none */
            touch?: components["schemas"]["AllowedTouch"][];
            /** @description Cell time at which the objects of `expiring` are removed; absent if no object expires */
            expires_s?: number;
            /** @description Names of the objects that expire; absent if there are none */
            expiring?: string[];
            /** @description Names of the objects that have expired with this version; absent if there are none */
            expired?: string[];
        };
        /** @description An input or output of the cell. */
        Signal: {
            name: string;
            /**
             * @description As seen from the server
             * @enum {string}
             */
            direction: "input" | "output";
            /**
             * @description bool, or integer: 0 to 65535
             * @enum {string}
             */
            type: "bool" | "integer";
            /** @description Device of the signal; null: the signal is simulated */
            device: string | null;
            /** @description Present value; null: not known */
            value: (boolean | number) | null;
            /** @description Value that was sent to the device, until the device reports it */
            commanded?: boolean | number;
            /** @description false while the server has no connection to the device, or while the device refuses this signal */
            is_connected: boolean;
            /** @description Why it is not connected */
            detail: string | null;
            /** @description Cell time of the last change of the value */
            changed_s: number;
        };
        /** @description `contact`, `clearance`: two bodies are too close. `approach`: two bodies will be too close unless an arm stops now. The other kinds report a violated premise of the certificates: an arm that is not where it should be, or feedback that is late, frozen or implausible. */
        MonitorFinding: {
            /** @enum {string} */
            kind: "contact" | "clearance" | "approach" | "deviation" | "unplanned_motion" | "early_finish" | "beyond_authority" | "stop_ignored" | "late_feedback" | "frozen_feedback" | "implausible_feedback";
            /** @description One sentence */
            text: string;
            /** @description Arms of the pair, or the arm that violates a premise */
            arms: string[];
            links?: [
                string,
                string
            ];
            /** @description Clearance found */
            clearance_m?: number;
            /** @description Clearance required */
            limit_m?: number;
            /** @description Joint that exceeds the limit most */
            joint?: string;
            /** @description Measured value: rad or m with `joint`, else s */
            value?: number;
            /** @description Largest permitted value */
            limit?: number;
            /** @description Arms that the monitor stopped */
            stopped: string[];
        };
        /** @description The authority guard refused movement authority that the scheduler had granted. This is a defect of the scheduler; the arm has not moved. */
        GuardFinding: {
            /**
             * @description Reason. `uncertified`: no certificate covers the authority; `region`: the authority enters a conflict region out of order; `busy`: the arm is on another motion; `out_of_step`: the arms of one motion are too far apart in progress
             * @enum {string}
             */
            kind: "uncertified" | "region" | "busy" | "out_of_step";
            arm: string;
            job: string;
            /** @description Other arm; empty if the refusal concerns the scene or only the arms of this motion */
            other_arm: string;
            /** @description Last job of the other arm, or empty */
            other_job: string;
            /** @description Authority that was refused: from the present progress of both arms to their authority */
            asked: components["schemas"]["ProgressBox"];
            /** @description First rectangle of the conflict region that `asked` overlaps */
            region?: components["schemas"]["ProgressBox"];
        };
        Alert: {
            /** @enum {string} */
            level: "info" | "warning" | "error";
            text: string;
        };
        /** @description Progress and movement authority of an arm on its motion. Times are trajectory time. */
        ArmAuthority: {
            arm: string;
            job: string;
            /** @description Measured progress */
            progress_s: number;
            /** @description Movement authority: the arm stops at this time unless more authority is granted */
            authority_s: number;
        };
        /** @description The kind of a robot's controller, and what it promises. */
        CellController: {
            /**
             * @description sim: simulated by the server; takes faults. remote: in a process of its own
             * @enum {string}
             */
            type: "sim" | "remote";
            /** @description Longest time from a command to its effect on the arm */
            reaction_s: number;
            /** @description Longest time between two reports */
            feedback_period_s: number;
            /** @description Age of the last report after which the arm is stopped */
            feedback_timeout_s: number;
            /** @description Largest deviation of a joint from its path: rad or m */
            tracking_error_rad: number;
        };
        CellArm: {
            name: string;
            /** @description Group of the SRDF */
            group: string;
            joints: string[];
            gripper_joints: string[];
            home: number[];
            named_states: {
                [key: string]: number[];
            };
        };
        /** @description An admitted motion. It begins after the previous motion of its arms; the time until then is not listed as a pause. */
        TimelineStep: {
            id: components["schemas"]["JobId"];
            /** @description Display name; may be empty */
            name: string;
            /** @description Arms that the job moves; the motion is listed under each of them */
            arms: string[];
            state: components["schemas"]["JobState"];
            /** @description Share of the trajectory's time at `now_s` */
            progress: number;
            /** @description Time at which the motion leaves its start, past or predicted; null if not predicted */
            starts_s: number | null;
            /** @description Predicted end; null if no end is predicted. The last pause then gives the reason, unless the job is canceled and its arm brakes */
            ends_s: number | null;
            /** @description Pauses from now on */
            pauses: components["schemas"]["TimelinePause"][];
        };
        Waypoint: {
            /** @description Joint positions in the order of `joint_names`: rad or m */
            positions: number[];
            /** @description Joint velocities; required unless the job has `retime`, because the motion must begin and end at rest. The first and last waypoint may leave out zeros */
            velocities?: number[];
            /** @description Joint accelerations, in all waypoints (quintic splines) or in none (cubic) */
            accelerations?: number[];
            /** @description Empty or zero */
            effort?: 0[];
            /**
             * @description Time from the start; required unless the job has `retime`. If the first is above 0, the motion begins where the arm will be
             * @default null
             */
            time_from_start: components["schemas"]["Time"];
        };
        Acknowledgement: {
            /** @description The token's name; without tokens, the name that the client gave, or its address */
            who: string;
            /** @description RFC 3339, UTC */
            at: string;
        };
        RecordingFile: {
            name: string;
            bytes: number;
        };
        /** @description An object that an arm holds. */
        HeldObject: {
            /** @description The object, with its pose in the frame of `link` */
            object: components["schemas"]["Object"];
            /** @description Link that carries the object */
            link: string;
            /** @description Arm that moves the link */
            arm: string;
            /** @description Links and objects that the object may touch at present, besides the hand that holds it; absent if there are none */
            touch?: string[];
            /** @description Other hands that hold the object, too: their arms and `arm` move only together; absent if there are none */
            shared_with?: components["schemas"]["OtherHand"][];
        };
        /** @enum {string} */
        ArmState: "idle" | "moving" | "paused" | "stopped" | "fault";
        /** @description Links that may touch an object of the scene at present, besides those that the cell file allows. */
        AllowedTouch: {
            object: string;
            links: string[];
        };
        /** @description A rectangle of two motions. Times are trajectory time. */
        ProgressBox: {
            /** @description Interval of the arm's own motion */
            from_s: number;
            to_s: number;
            /** @description Interval of the other motion */
            other_from_s: number;
            other_to_s: number;
        };
        /** @description A pause of a motion, at its start or on its path. */
        TimelinePause: {
            from_s: number;
            /** @description End of the pause; null if no end is predicted (only for the last pause) */
            to_s: number | null;
            /** @description Position of the pause in trajectory time */
            at_s: number;
            /** @description What the motion waits for; null if its own arms cause the pause. Such a pause is predicted to last as long again as it has lasted so far */
            waits_on: components["schemas"]["Wait"] | null;
        };
        /** @description A ROS 2 time, a ROS 1 time, or a number of seconds. */
        Time: number | {
            sec: number;
            nanosec: number;
        } | {
            secs: number;
            nsecs: number;
        };
        /** @description A further hand that holds an object. */
        OtherHand: {
            link: string;
            /** @description Arm that moves the link */
            arm: string;
        };
    };
    responses: never;
    parameters: never;
    requestBodies: never;
    headers: never;
    pathItems: never;
}
export type $defs = Record<string, never>;
export type operations = Record<string, never>;
