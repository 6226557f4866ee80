// Written by `npm run contract`: change the descriptions in server/messages, not this file.
export type paths = Record<string, never>;
export type webhooks = Record<string, never>;
export interface components {
    schemas: {
        /** @description What WebSocket and SSE carry. */
        Message: components["schemas"]["SnapshotEvent"] | components["schemas"]["JobEvent"] | components["schemas"]["ArmEvent"] | components["schemas"]["QueueEvent"] | components["schemas"]["SceneEvent"] | components["schemas"]["MonitorEvent"] | components["schemas"]["GuardEvent"] | components["schemas"]["AlertEvent"] | components["schemas"]["StateFrame"];
        Cell: {
            name: string;
            /** @description In force */
            policy: string;
            /** @description Cell seconds per wall second */
            speed: number;
            /** @description No drive moves: every arm is simulated */
            simulated: boolean;
            robots: components["schemas"]["CellRobot"][];
            objects: components["schemas"]["Object"][];
            joints: components["schemas"]["CellJoint"][];
            /** @description What every admitted motion keeps from other arms and the scene. */
            clearance_m: number;
            /** @description What an arm's own links keep from each other; at most clearance_m counts. */
            self_clearance_m: number;
            /** @description What an arm keeps from the link that carries it: clearance_m unless given, as that link may be a table; at most clearance_m counts. Less (0.005) where an arm folds on its own base or works beside its own body. */
            mount_clearance_m?: number;
            /** @description What the checks of motions allow for. */
            checking: {
                /** @description Time between the instants that the policy timed_discrete compares. */
                time_step_s: number;
                /** @description How far each joint may be off its path: every proof covers it. */
                tracking_error_rad: number;
                /** @description How far a motion is expected to be behind its plan: controllers with a larger lag_s are warned of. Motions go by measured progress, so nothing that is certified depends on it. */
                delay_s: number;
                /** @description Share by which a trajectory may exceed a limit of velocity, acceleration or jerk between its waypoints. */
                limit_tolerance: number;
            };
            /** @description Which job goes when. */
            scheduling: {
                /**
                 * @description The rule by which jobs start; `armloom compare` shows what each makes of your jobs.
                 * @enum {string}
                 */
                policy: "sequential" | "lockstep" | "reservation" | "timed_discrete" | "certified" | "earliest_start" | "coordinated";
                /** @description A job that has waited so long in the backlog expires, unless it says otherwise. */
                backlog_timeout_s: number;
                /** @description A job that has waited so long is overtaken no more. */
                aging_s: number;
                /**
                 * @description An arm without a job in the way of one, and jobs that wait for each other: park sends an arm aside, replan plans another way to where the job ends (what its trajectory was to do on the way is lost) and parks where there is none, report only tells of it.
                 * @enum {string}
                 */
                on_idle_blocker: "report" | "park" | "replan";
                /** @description Of each arm so many jobs are admitted together, the one under way included; who passes first is chosen for all of them (coordinated only). Decisions take longer with the square of it: above 12 tens of milliseconds. */
                horizon_steps: number;
                /**
                 * @description What a server with `--data` that is started again does with jobs that had not ended: ask stops all arms until they are resumed, continue goes on with those that had not begun.
                 * @enum {string}
                 */
                on_restart: "ask" | "continue";
            };
            /** @description The watch over the measured state of all arms. */
            monitor: {
                /** @description How often the measured state is looked at. */
                rate_hz: number;
                /** @description Time from a finding to the first arm that brakes. */
                reaction_s: number;
                /** @description Links closer than this stop their arms. At most clearance_m. */
                stop_clearance_m: number;
            };
            /** @description When a motion may begin and when it has failed; the defaults are MoveIt's. */
            execution: {
                /** @description How far an arm may stand from where its job begins. */
                start_tolerance_rad: number;
                /** @description A motion fails as overrun when it takes longer than this times its duration, plus the margin, and has not moved for 10 s. */
                duration_scaling: number;
                /** @description The margin of that; larger where arms may stall for longer. */
                duration_margin_s: number;
                /** @description As MoveIt's default: the share of the joints' speeds of every motion whose times the server makes: goals, paths to be timed, other ways, ways aside. A request's own velocity_scaling_factor takes its place. Trajectories with times are run as they are given. */
                velocity_scaling_factor: number;
            };
        };
        /** @description A job as the server gives it. */
        Job: {
            id: components["schemas"]["JobId"];
            /** @description For people; may be empty */
            name: string;
            state: components["schemas"]["JobState"];
            /** @description That it moves */
            arms: string[];
            /** @description Larger goes first */
            priority: number;
            /** @description How long it may wait in the backlog. Default: the cell's */
            backlog_timeout_s?: number;
            /**
             * @description What becomes of it then. "replan": another way is planned to where it ends, from where its arm stands and past what rests there; it expires when there is none, and after the third
             * @enum {string}
             */
            on_timeout?: "abort" | "replan";
            /**
             * @description "plan": its arms need not stand where it begins; each that stands elsewhere at its turn is brought there first, slowly, by a planned motion of the server's own
             * @enum {string}
             */
            approach?: "none" | "plan";
            /**
             * @description "any": jobs of one arm that begin and end at one place, and say so, may be taken in another order
             * @enum {string}
             */
            order?: "as_given" | "any";
            /** @description When it was accepted, in cell time */
            submitted_s: number;
            /**
             * Format: date-time
             * @description The same in wall time
             */
            submitted_at: string;
            /** @description When it first was found in conflict, in cell time; absent: never */
            backlogged_s?: number;
            /** @description When it is given up if nothing changes, in cell time: while it waits in the backlog, or on its path for what no job moves */
            expires_s?: number;
            /** @description When it starts; null: not planned, in cell time */
            scheduled_s: number | null;
            /**
             * Format: date-time
             * @description The same in wall time
             */
            scheduled_at: string | null;
            /** @description When it began to move; null: not yet, in cell time */
            started_s: number | null;
            /**
             * Format: date-time
             * @description The same in wall time
             */
            started_at: string | null;
            /** @description When it ended; null: not yet, in cell time */
            ended_s: number | null;
            /**
             * Format: date-time
             * @description The same in wall time
             */
            ended_at: string | null;
            /** @description Share of the trajectory's time */
            progress: number;
            /** @description Of the trajectory */
            duration_s: number;
            /** @description Of a goal: whether its way is planned; until then duration_s is an estimate */
            planned?: boolean;
            /** @description Brakes on its path */
            stopping: boolean;
            /** @description Empty when it does not wait */
            waits_on: components["schemas"]["Wait"][];
            /** @description Arms of which one does it; `arms` is that one, or the likeliest while it waits */
            alternatives?: string[];
            /** @description Other ways that were looked for, to where its own ends */
            replan?: {
                /** @description So many times it was given another way */
                done: number;
                /** @description One is being looked for: it stays where it is */
                planning: boolean;
                /**
                 * @description Of the last time: POST /jobs/{id}/replan, on_timeout, or on_idle_blocker
                 * @enum {string}
                 */
                cause: "client" | "timeout" | "blocked";
                /** @description Why it kept its own, the last time */
                refused: string | null;
            };
            /** @description Of a goal whose shortest way would have to wait: ways around what others hold */
            detour?: {
                /** @description So many ways around */
                weighed: number;
                /** @description It goes by one of them */
                taken: boolean;
                /** @description By so much sooner it arrives by that, as it was predicted; null: none is taken, or the shortest way could not go as things stood */
                time_saved_s: number | null;
            };
            /** @description Why it was taken before others, or by this arm */
            choice?: {
                /** @description Jobs that could have taken the turn, or arms that could have done it: as it was first */
                among: string[];
                /** @description One of these */
                taken: string;
                /** @description By so much the plan costs less than with the first, or a goal's job arrives sooner; null: that is taken, or could not go */
                time_saved_s: number | null;
                detail: string;
            };
            /** @description The deadlock that it is part of, itself first: each waits for the next one, the last for the first. Else empty */
            ring: string[];
            /** @description null until terminal */
            result: {
                reason: components["schemas"]["Reason"];
                detail: string;
            } | null;
        };
        /** @description Of two motions. Times in cells, and of progress, are trajectory time. */
        Diagram: {
            /** @description Cell time of state and progress */
            t_s: number;
            a: components["schemas"]["DiagramSide"];
            b: components["schemas"]["DiagramSide"];
            /** @description One for each arm of A and each other arm of B */
            layers: {
                /** @description Of A, of B */
                arms: [
                    string,
                    string
                ];
                /** @description Cover the rectangle of both durations and do not overlap; not with cells=false */
                cells?: components["schemas"]["DiagramCell"][];
                /** @description The first conflict, else the first undecided cell, if both go on from where they are, and who ends first rests; null: through free cells only */
                met: components["schemas"]["DiagramContact"] | null;
            }[];
            evaluations: number;
            scene_version: number;
        };
        /** @description Times are cell time, if not said otherwise. */
        Timeline: {
            now_s: number;
            /** @description So many legs of a lane are admitted at most, the one under way included */
            horizon_steps: number;
            /** @description In the cell's order */
            arms: components["schemas"]["TimelineArm"][];
        };
        /** @description RFC 9457. */
        Problem: {
            type: string;
            title: string;
            status: number;
            /** @description One sentence with numbers and units */
            detail: string;
            /** @description JSON pointer into the body; else the place in words */
            pointer?: string;
            /** @description What was found there */
            value?: string | number | null;
            /** @description When several faults were found: all of them, the first one too */
            errors?: {
                pointer: string;
                detail: string;
                /** @description What was found there */
                value: string | number | null;
            }[];
            /** @description Where there is no plan: the two that come too close, or the one that is not brought to its pose */
            links?: string[];
            /** @description How close the two come; zero or less in contact */
            clearance_m?: number;
            /** @description How far apart they are to be */
            required_clearance_m?: number;
            /** @description Joint positions that would do, the nearest that were found: free ones; of a pose that is not reached those that come nearest to it; of a straight line as far as it goes */
            nearest?: number[];
            /** @description What planning took */
            evaluations?: number;
        };
        /** @description The answer of the admission code to: what if this job came now? */
        Verdict: {
            /** @enum {string} */
            verdict: "free" | "conflict" | "undecided";
            /** @description From now; 0 where it would start at once, null when not known */
            earliest_start_s: number | null;
            /** @description What is proven to be kept between arms, and by arms from what stands still: the least that any such pair was held to */
            clearance_bound_m: number | null;
            /** @description The same of the links of one arm from each other */
            self_clearance_bound_m: number | null;
            /** @description As the job's own would be: of a free one, what it would wait for before it starts */
            waits_on: components["schemas"]["Wait"][];
            /** @description The same, where it is not free */
            conflicts: components["schemas"]["Wait"][];
            evaluations: number;
            scene_version: number;
            /** @description Of a goal that several arms could go to: which one would */
            choice?: {
                /** @description Jobs that could have taken the turn, or arms that could have done it: as it was first */
                among: string[];
                /** @description One of these */
                taken: string;
                /** @description By so much the plan costs less than with the first, or a goal's job arrives sooner; null: that is taken, or could not go */
                time_saved_s: number | null;
                detail: string;
            };
            /** @description Of a job that asks for an approach: so long its arms would take to where it begins. The verdict is of that motion; where it would not be admitted together with it, the job is judged again when it is there */
            approach_s?: number;
            /** @description It would end at once, without moving */
            result?: {
                reason: components["schemas"]["Reason"];
                detail: string;
            };
        };
        /** @description How a job moves its arms. */
        JobMotion: {
            /** @description Of the job */
            id: components["schemas"]["JobId"];
            duration_s: number;
            /** @description As POST /jobs takes it: it makes the same motion */
            trajectory: components["schemas"]["JointTrajectory"] | components["schemas"]["RobotTrajectory"];
        };
        /** @description A motion, not executed. */
        Plan: {
            /** @description That goes */
            arm: string;
            /** @description Of `arms`, those that would not: when each would arrive, or why it cannot */
            others: {
                arm: string;
                /** @description From now; null: it has no way, or when it could go is not known */
                arrives_s: number | null;
                detail: string;
            }[];
            /** @description As POST /jobs takes it */
            trajectory: components["schemas"]["JointTrajectory"] | components["schemas"]["RobotTrajectory"];
            duration_s: number;
            /** @description Of the way in joint space, rad or m */
            length: number;
            /** @description The same of the straight line */
            straight: number;
            /** @description Stretches of lines that were looked at */
            evaluations: number;
            /** @description What POST /check says of it now */
            verdict?: components["schemas"]["Verdict"];
            /** @description Instead: why POST /jobs would refuse it now */
            not_checked_reason?: components["schemas"]["Problem"];
        };
        AlertList: {
            /** @description Newest first */
            alerts: components["schemas"]["KeptAlert"][];
        };
        /** @description Who asks, and what they may. */
        Session: {
            /** @description Else everybody may everything */
            auth_required: boolean;
            /** @description Of the token; null: there is none */
            name: string | null;
            /** @description null: may nothing but log in */
            role: ("viewer" | "operator" | "admin") | null;
        };
        /** @description The same jobs under several policies, in simulation. */
        Comparison: {
            /** @enum {string} */
            state: "running" | "done" | "canceled" | "failed";
            /** @description That are compared */
            jobs: number;
            /** @description When the first of them was submitted */
            first_s: number;
            /** @description And the last */
            last_s: number;
            /** @description The policy, when the comparison was asked for */
            in_force: string;
            /** @description In the order of the runs */
            policies: string[];
            /** @description Those that are done */
            runs: components["schemas"]["PolicyRun"][];
            /** @description Why it failed; else empty */
            detail: string;
        };
        /** @description Who may move arms by hand. */
        Control: {
            /** @description null: nobody */
            holder: components["schemas"]["ControlHolder"] | null;
        };
        ControlTaken: {
            holder: components["schemas"]["ControlHolder"] | null;
            /** @description To be shown with every move by hand; told this once */
            key?: string;
        };
        /** @description A move by hand, as it is now. */
        Jog: {
            job: components["schemas"]["Job"];
            /** @description The arm brakes when it is not renewed for so long, in wall time */
            lease_s: number;
        };
        JobPage: {
            jobs: components["schemas"]["Job"][];
            /** @description For ?cursor=; null on the last page */
            next_cursor: string | null;
        };
        MeasuredStates: {
            /** @description The run, as events name it */
            stream: string;
            /** @description Every joint of the cell */
            joints: string[];
            /** @description Ascending */
            t_s: number[];
            /** @description At each of these times, in the order of the joints: rad or m */
            q: number[][];
        };
        RecordingList: {
            /** @description Whether this server records: without `--data` it does not */
            kept: boolean;
            /** @description Newest first */
            recordings: components["schemas"]["Recording"][];
        };
        SnapshotEvent: {
            /**
             * Format: uuid
             * @description Of this run of the server
             */
            stream: string;
            /** @description Without holes within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "snapshot";
            /** @description Cell time */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time
             */
            at: string;
            data: components["schemas"]["Snapshot"];
        };
        JobEvent: {
            /**
             * Format: uuid
             * @description Of this run of the server
             */
            stream: string;
            /** @description Without holes within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "job";
            /** @description Cell time */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time
             */
            at: string;
            data: components["schemas"]["Job"];
        };
        ArmEvent: {
            /**
             * Format: uuid
             * @description Of this run of the server
             */
            stream: string;
            /** @description Without holes within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "arm";
            /** @description Cell time */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time
             */
            at: string;
            data: components["schemas"]["Arm"];
        };
        QueueEvent: {
            /**
             * Format: uuid
             * @description Of this run of the server
             */
            stream: string;
            /** @description Without holes within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "queue";
            /** @description Cell time */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time
             */
            at: string;
            data: components["schemas"]["QueueIds"];
        };
        SceneEvent: {
            /**
             * Format: uuid
             * @description Of this run of the server
             */
            stream: string;
            /** @description Without holes within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "scene";
            /** @description Cell time */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time
             */
            at: string;
            data: components["schemas"]["Scene"];
        };
        MonitorEvent: {
            /**
             * Format: uuid
             * @description Of this run of the server
             */
            stream: string;
            /** @description Without holes within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "monitor";
            /** @description Cell time */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time
             */
            at: string;
            data: components["schemas"]["MonitorFinding"];
        };
        GuardEvent: {
            /**
             * Format: uuid
             * @description Of this run of the server
             */
            stream: string;
            /** @description Without holes within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "guard";
            /** @description Cell time */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time
             */
            at: string;
            data: components["schemas"]["GuardFinding"];
        };
        AlertEvent: {
            /**
             * Format: uuid
             * @description Of this run of the server
             */
            stream: string;
            /** @description Without holes within a stream */
            seq: number;
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "alert";
            /** @description Cell time */
            t_s: number;
            /**
             * Format: date-time
             * @description Wall time
             */
            at: string;
            data: components["schemas"]["Alert"];
        };
        /** @description Poses, about 30 Hz of wall time; dropped for slow readers. */
        StateFrame: {
            /**
             * @description discriminator enum property added by openapi-typescript
             * @enum {string}
             */
            type: "state";
            t_s: number;
            /** @description Every joint of the cell, rad or m */
            q: {
                [key: string]: number;
            };
            clearance: {
                /** @description Two, or one and the scene: an object, or a link that no arm moves */
                arms: string[];
                m: number;
                links: [
                    string,
                    string
                ];
            }[];
            /** @description Of every arm that has been told to move */
            motions: components["schemas"]["ArmAuthority"][];
            /** @description Cell seconds per wall second */
            speed: number;
        };
        CellRobot: {
            name: string;
            prefix: string;
            base: {
                /** @description Position in metres. */
                xyz: [
                    number,
                    number,
                    number
                ];
                /** @description Roll, pitch, yaw about fixed axes, in rad, as in a URDF. */
                rpy: [
                    number,
                    number,
                    number
                ];
            };
            /** @description XML, names without prefix */
            urdf: string;
            /** @description XML */
            srdf: string;
            /** @description Address of each mesh that the URDF names */
            meshes: {
                [key: string]: string;
            };
            arms: components["schemas"]["CellArm"][];
        };
        /** @description An object of the scene: exactly one shape. A mesh is told by its address. */
        Object: {
            /** @description The object's name; unique in the cell, and no link's or robot's name. */
            name: string;
            /** @description A box: its full side lengths, in metres. */
            box?: [
                number,
                number,
                number
            ];
            /** @description A cylinder along z: radius and full length, in metres. */
            cylinder?: [
                number,
                number
            ];
            /** @description A sphere: radius, in metres. */
            sphere?: [
                number
            ];
            /** @description A mesh (STL, OBJ, DAE): a file. All that it encloses counts as solid, cavities too. */
            mesh?: string;
            /** @description Of a mesh: factors along x, y, z of the file's lengths. */
            scale?: [
                number,
                number,
                number
            ];
            /** @description Position in metres. */
            xyz: [
                number,
                number,
                number
            ];
            /** @description Roll, pitch, yaw about fixed axes, in rad, as in a URDF. */
            rpy: [
                number,
                number,
                number
            ];
        } & (unknown | unknown | unknown | unknown);
        CellJoint: {
            name: string;
            /** @description null: of none */
            arm: string | null;
            /** @description null: none */
            lower: number | null;
            /** @description null: none */
            upper: number | null;
            velocity_max: number;
            acceleration_max: number;
            jerk_max: number;
            brake: number;
            /** @enum {string} */
            unit: "rad" | "m";
        };
        /** @description The client's choice, or the server's. */
        JobId: string;
        /**
         * @description The last five are terminal: a job reaches exactly one of them.
         * @enum {string}
         */
        JobState: "queued" | "backlogged" | "scheduled" | "running" | "paused" | "succeeded" | "canceled" | "expired" | "failed" | "interrupted";
        /** @description What a job waits for, with the evidence. */
        Wait: {
            /** @enum {string} */
            kind: "job" | "arm" | "object" | "order" | "capacity" | "stop" | "plan" | "check" | "guard";
            /** @description The other job */
            id: string | null;
            /** @description The other arm */
            arm: string | null;
            /** @description Own link, then the other's, or an object; empty without evidence */
            links: string[];
            /** @description From the start of this trajectory */
            own_time_s: number | null;
            /** @description From the start of the other's */
            other_time_s: number | null;
            /** @description Distance found; zero or less in contact */
            clearance_m: number | null;
            /** @description Of a stop: its cause */
            detail?: string;
            /** @description Of a check: the share of its budget that it has used; most end early */
            progress?: number;
        };
        /**
         * @description A closed list; core/scheduler/README.md explains each.
         * @enum {string}
         */
        Reason: "completed" | "canceled_by_client" | "backlog_timeout" | "start_mismatch" | "self_collision" | "predecessor_failed" | "arm_fault" | "overrun" | "server_restart" | "deadlock" | "no_plan";
        DiagramSide: {
            id: components["schemas"]["JobId"];
            state: components["schemas"]["JobState"];
            duration_s: number;
            progress_s: number;
        };
        DiagramCell: {
            /**
             * @description free: the clearance is kept in every state of the cell; conflict: in none; undecided: in some, or neither is proven
             * @enum {string}
             */
            state: "free" | "conflict" | "undecided";
            /** @description From, to */
            a_s: [
                number,
                number
            ];
            /** @description From, to */
            b_s: [
                number,
                number
            ];
        };
        DiagramContact: {
            /** @enum {string} */
            state: "free" | "conflict" | "undecided";
            /** @description After t_s */
            in_s: number;
            a_s: number;
            b_s: number;
        };
        TimelineArm: {
            /** @description The arm */
            name: string;
            /** @description In the order in which they go */
            legs: components["schemas"]["TimelineStep"][];
            /** @description Jobs of the arm (of their `arms`) that have not ended and are no leg: not admitted, behind the horizon or for other reasons. They have no times yet */
            waiting: number;
        };
        /** @description The shape of trajectory_msgs/JointTrajectory. */
        JointTrajectory: {
            /** @description Prefix + URDF name; joints of several arms make one synchronous motion */
            joint_names: string[];
            points: components["schemas"]["Waypoint"][];
            /** @description Read over */
            header?: Record<string, never>;
        };
        /** @description MoveIt's nesting. */
        RobotTrajectory: {
            joint_trajectory: components["schemas"]["JointTrajectory"];
            /** @description Must be empty */
            multi_dof_joint_trajectory?: {
                joint_names?: unknown[];
                points?: unknown[];
            };
        };
        /** @description What somebody has to see to, until somebody has. */
        KeptAlert: {
            /** @description `<stream>:<seq>` of the event that told it */
            id: string;
            /** @description RFC 3339, UTC */
            at: string;
            /** @description warning, error */
            level: string;
            text: string;
            /** @description null: by nobody yet */
            acknowledged: components["schemas"]["Acknowledgement"] | null;
        };
        /** @description What would have become of the jobs under this policy: simulated. */
        PolicyRun: {
            policy: string;
            succeeded: number;
            expired: number;
            failed: number;
            /** @description By the server: interrupted ones, too */
            canceled: number;
            /** @description When they came: they would not have begun where their arm would have stood */
            refused: number;
            /** @description When nothing could happen any more, or the run was given up */
            unfinished: number;
            /** @description Waited in the backlog, at least once */
            backlogged: number;
            /** @description From the first submission to the last end; null: not all ended, or none started */
            makespan_s: number | null;
            /** @description makespan_s, divided by that of `sequential`; null: not known */
            makespan_ratio: number | null;
            /** @description From submission to start */
            wait_mean_s: number;
            wait_max_s: number;
            /** @description The smallest that the monitor saw; null: never near */
            min_clearance_m: number | null;
            monitor_stops: number;
            /** @description Combined states looked at to decide */
            evaluations: number;
            /** @description It took more evaluations than one run may: figures are of what was done by then */
            given_up: boolean;
        };
        ControlHolder: {
            who: string;
            /** @description RFC 3339, UTC */
            since_at: string;
            /** @description That they moved by hand last */
            arm: string | null;
            /** @description By this job */
            job: components["schemas"]["JobId"] | null;
        };
        /** @description What one run of a server has written down. */
        Recording: {
            /** @description Of its folder; `data`: it stands in the data folder itself */
            name: string;
            /** @description RFC 3339, UTC; null: not known */
            begun_at: string | null;
            /** @description Last: RFC 3339, UTC */
            written_at: string;
            /** @description It is being written */
            running: boolean;
            /** @description Whether joint positions are in it, which `serve` records with `--record` */
            has_states: boolean;
            /** @description What GET hands out of it */
            files: components["schemas"]["RecordingFile"][];
        };
        Snapshot: {
            cell: string;
            policy: string;
            speed: number;
            stopped: boolean;
            arms: components["schemas"]["Arm"][];
            /** @description All that have not ended, and the 200 that ended last */
            jobs: components["schemas"]["Job"][];
            queue: components["schemas"]["QueueIds"];
            objects: components["schemas"]["Object"][];
            /** @description Events are missing before this */
            gap?: boolean;
        };
        Arm: {
            name: string;
            robot: string;
            state: components["schemas"]["ArmState"];
            /** @description In motion or paused */
            job: string | null;
            progress: number;
            joints: string[];
            /** @description Measured, rad or m */
            q: number[];
            home: number[];
            /** @description Measured distance from its own path, largest joint */
            deviation_rad: number;
        };
        QueueIds: {
            /** @description In force; recordings from before it was told lack it */
            policy?: string;
            /** @description Every arm is stopped */
            stopped: boolean;
            queued: string[];
            backlog: string[];
            scheduled: string[];
            running: string[];
        };
        Scene: {
            /** @description Grows with every change */
            version: number;
            objects: components["schemas"]["Object"][];
        };
        MonitorFinding: {
            /** @enum {string} */
            kind: "contact" | "clearance";
            arms: string[];
            links: [
                string,
                string
            ];
            /** @description Found */
            clearance_m: number;
            /** @description What it should have been */
            limit_m: number;
            /** @description Arms that were told to stop */
            stopped: string[];
        };
        /** @description The authority guard kept an arm from what the scheduler had granted. This is a defect of the scheduler; nothing has moved */
        GuardFinding: {
            /**
             * @description Why: no certificate covers it, it meets a conflict region, the arm is on another motion, or the arms of one motion are too far apart on it
             * @enum {string}
             */
            kind: "uncertified" | "region" | "busy" | "out_of_step";
            arm: string;
            job: string;
            /** @description Empty: the scene, or the motion's own arms */
            other_arm: string;
            /** @description That the other arm was on last; or empty */
            other_job: string;
            /** @description From where the arms are to their authority */
            asked: components["schemas"]["ProgressBox"];
            /** @description The first rectangle that is met */
            region?: components["schemas"]["ProgressBox"];
        };
        Alert: {
            /** @enum {string} */
            level: "info" | "warning" | "error";
            text: string;
        };
        /** @description What an arm may do of a motion. Trajectory time. */
        ArmAuthority: {
            arm: string;
            job: string;
            /** @description Measured */
            progress_s: number;
            /** @description It may go so far, and stops there unless more is granted */
            authority_s: number;
        };
        CellArm: {
            name: string;
            /** @description Of the SRDF */
            group: string;
            joints: string[];
            gripper_joints: string[];
            home: number[];
            named_states: {
                [key: string]: number[];
            };
        };
        /** @description A motion that is admitted. It follows the one before it on its arms; that wait is no pause. */
        TimelineStep: {
            id: components["schemas"]["JobId"];
            /** @description For people; may be empty */
            name: string;
            /** @description That it moves, each in its lane */
            arms: string[];
            state: components["schemas"]["JobState"];
            /** @description Share of the trajectory's time, at now_s */
            progress: number;
            /** @description Leaves its start, or has left it; null: never, as things are */
            starts_s: number | null;
            /** @description null: it does not come to its end as things are; its last pause says what holds it, unless it is given up and brakes */
            ends_s: number | null;
            /** @description From now on */
            pauses: components["schemas"]["TimelinePause"][];
        };
        Waypoint: {
            /** @description rad or m, in the order of joint_names */
            positions: number[];
            /** @description Absent: refused, since the motion could not begin and end at rest */
            velocities?: number[];
            /** @description In all waypoints (quintic) or in none (cubic) */
            accelerations?: number[];
            /** @description Read over */
            effort?: unknown[];
            /**
             * @description Absent: refused, unless the job says "retime"
             * @default null
             */
            time_from_start: components["schemas"]["Time"];
        };
        Acknowledgement: {
            /** @description The token's name, or whoever said to be it */
            who: string;
            /** @description RFC 3339, UTC */
            at: string;
        };
        RecordingFile: {
            name: string;
            bytes: number;
        };
        /** @enum {string} */
        ArmState: "idle" | "moving" | "paused" | "stopped" | "fault";
        /** @description Two stretches of two motions. Trajectory time. */
        ProgressBox: {
            /** @description Of the arm's own motion */
            from_s: number;
            to_s: number;
            /** @description Of the other motion */
            other_from_s: number;
            other_to_s: number;
        };
        /** @description A leg stands, at its start or on its way. */
        TimelinePause: {
            from_s: number;
            /** @description null: for ever as things are; then it is the last one */
            to_s: number | null;
            /** @description Where, in trajectory time */
            at_s: number;
            /** @description For whom; null: for a reason of its arms' own, expected to last for as long again */
            waits_on: components["schemas"]["Wait"] | null;
        };
        /** @description ROS 2's, ROS 1's, or a number of seconds. */
        Time: number | {
            sec: number;
            nanosec: number;
        } | {
            secs: number;
            nsecs: number;
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
