// Pasted jobs that say where to go instead of how: their paths as the server would plan them now, so that
// they can be looked at before they are sent. Nothing is stored, and the server plans again at their turn.

import { child, read_trajectory } from '../motion/motion';
import type { Api } from '../server/api';
import type { Arm, Cell, Problem } from '../server/messages';
import { read_batch, type Batch } from './batch';
import { arm_of, states_of } from './goal';

const kMost = 12;  // each takes the server some time

export interface GoalPaths {
  /** The same jobs, each goal with its way. */
  batch: Batch;
  planned: number;
  /** Goals beyond those that are planned here. */
  left_out: number;
  /** Of the first that has no way. */
  problem: Problem | null;
}

type Known = { arms: ReadonlyMap<string, Pick<Arm, 'joints'>>; cell: Cell | null };
type Body = Record<string, unknown>;

/** Whether there is a goal that the server can be asked about: what is half typed is left alone. */
export function has_goal(batch: Batch, known: Known): boolean {
  return bodies(batch).some((body) => goal_in(body, known) !== null);
}

/** One after the other: each begins where the one before has led its arm. */
export async function paths_to_goals(batch: Batch, known: Known, api: Pick<Api, 'plan'>): Promise<GoalPaths> {
  const ends = new Map<string, number>();  // where joints are at the end of what comes before
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

/** As POST /plan asks for it; null: none, or one that it would refuse for what is written there. */
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

/** Absent: where the arm will be when all that the server has accepted has run. */
function start_of(goal: Body, ends: ReadonlyMap<string, number>, { arms }: Known): { start?: { joints: number[] } } {
  const joints = typeof goal['arm'] === 'string' ? arms.get(goal['arm'])?.joints ?? [] : [];
  const at = joints.flatMap((joint) => ends.get(joint) ?? []);
  return joints.length > 0 && at.length === joints.length ? { start: { joints: at } } : {};
}
