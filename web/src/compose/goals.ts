// Plans paths to the goals of pasted jobs, for a preview. The server stores nothing, and plans
// again when a job's turn comes.

import { child, read_trajectory } from '../motion/motion';
import type { Api } from '../server/api';
import type { Arm, Cell, Problem } from '../server/messages';
import { read_batch, type Batch } from './batch';
import { arm_of, states_of } from './goal';

const kMost = 12;  // most goals that are planned, because each costs the server time

export interface GoalPaths {
  /** The given jobs. Each job with a goal also has its planned trajectory. */
  batch: Batch;
  planned: number;
  /**
   * The number of goals that were not planned, because of the limit or after a goal without a path.
   */
  left_out: number;
  /** The problem of the first goal without a path. */
  problem: Problem | null;
}

type Known = { arms: ReadonlyMap<string, Pick<Arm, 'joints'>>; cell: Cell | null };
type Body = Record<string, unknown>;

/**
 * Returns true if a job has a complete goal, which the server can plan. Incomplete goals are
 * skipped.
 */
export function has_goal(batch: Batch, known: Known): boolean {
  return bodies(batch).some((body) => goal_in(body, known) !== null);
}

/** Plans one goal after the other. Each path starts where the previous job leaves its arm. */
export async function paths_to_goals(batch: Batch, known: Known, api: Pick<Api, 'plan'>): Promise<GoalPaths> {
  const ends = new Map<string, number>();  // joint positions at the end of the previous jobs
  const paths: GoalPaths = { batch, planned: 0, left_out: 0, problem: null };
  const done: unknown[] = [];
  for (const body of bodies(batch)) {
    const goal = goal_in(body, known);
    let trajectory: unknown = child(body, 'trajectory');
    if (goal && (paths.planned >= kMost || paths.problem)) paths.left_out += 1;
    else if (goal) {
      const answer = await api.plan(JSON.stringify({ ...goal, ...start_of(goal, ends, known) }));
      if (answer.ok) {
        trajectory = answer.value.trajectory;
        paths.planned += 1;
      } else paths.problem = answer.problem;
    }
    const piece = read_trajectory(trajectory);
    piece?.names.forEach((joint, i) => ends.set(joint, piece.points.at(-1)?.q[i] ?? 0));
    done.push(trajectory === undefined ? body : { ...(body as Body), trajectory });
  }
  paths.batch = batch.kind === 'batch' ? { kind: 'batch', jobs: done } : read_batch(JSON.stringify(done[0]));
  return paths;
}

function bodies(batch: Batch): readonly unknown[] {
  if (batch.kind === 'batch') return batch.jobs;
  try {
    return [JSON.parse(batch.text)];
  } catch {
    return [];
  }
}

/**
 * Returns the goal as POST /plan expects it. Null if the job has no goal, or a goal that the server
 * would refuse.
 */
function goal_in(body: unknown, { arms, cell }: Known): Body | null {
  const [to, arm, choice] = [child(body, 'move_to'), child(body, 'arm'), child(body, 'arms')];
  const names = typeof arm === 'string' ? [arm] : Array.isArray(choice) ? (choice as unknown[]) : [];
  if (typeof to !== 'object' || to === null || names.length === 0 || !cell) return null;
  for (const name of names) {
    const known = typeof name === 'string' ? arms.get(name) : undefined;
    if (!known || typeof name !== 'string') return null;
    const [named, joints] = [child(to, 'named'), child(to, 'joints')];
    if (named !== undefined && !states_of(arm_of(cell, name)).includes(String(named))) return null;
    if (joints !== undefined && (!Array.isArray(joints) || joints.length !== known.joints.length)) return null;
    if (named === undefined && joints === undefined && !is_place(child(child(to, 'pose'), 'xyz'))) return null;
  }
  const speed = child(body, 'velocity_scaling_factor');
  return { ...(typeof arm === 'string' ? { arm } : { arms: names }), to, ...(typeof speed === 'number' ? { velocity_scaling_factor: speed } : {}) };
}

function is_place(xyz: unknown): boolean {
  return Array.isArray(xyz) && xyz.length === 3 && xyz.every((m) => typeof m === 'number');
}

/**
 * Returns the start state for the request. Returns {} if no previous job moves the arm: the server
 * then starts where the arm's accepted jobs end.
 */
function start_of(goal: Body, ends: ReadonlyMap<string, number>, { arms }: Known): { start?: { joints: number[] } } {
  const joints = typeof goal['arm'] === 'string' ? arms.get(goal['arm'])?.joints ?? [] : [];
  const at = joints.flatMap((joint) => ends.get(joint) ?? []);
  return joints.length > 0 && at.length === joints.length ? { start: { joints: at } } : {};
}
