import { describe, expect, it } from 'vitest';
import { read_batch } from '../src/compose/batch';
import { has_goal, paths_to_goals } from '../src/compose/goals';
import { motion_of } from '../src/motion/pasted';
import type { Answer } from '../src/server/api';
import type { Arm, Cell, Plan, Problem } from '../src/server/messages';
import { arm_json } from './samples';

const arms = new Map(['left', 'right'].map((name) => [name, arm_json(name) as Arm]));
const cell = { robots: ['left', 'right'].map((name) => ({ arms: [{ name, named_states: { ready: [0.3, -1] } }] })) } as unknown as Cell;
const known = { arms, cell };

/**
 * Returns a server that plans a straight line to the requested joints. The line begins at the given
 * start, or at zero.
 */
function planner() {
  const asked: Record<string, unknown>[] = [];
  const plan = async (text: string): Promise<Answer<Plan>> => {
    const { arm = 'right', to, start, ...rest } = JSON.parse(text) as { arm?: string; to: { joints?: number[] }; start?: { joints: number[] } };
    asked.push({ arm, to, start, ...rest });
    if (to.joints?.[0] === 9) return { ok: false, problem: { type: 'urn:armloom:problem:outside-limits', title: 'No plan', status: 422 } as Problem };
    const points = [start?.joints ?? [0, 0], to.joints ?? [0.3, -1]].map((positions, i) => ({ positions, time_from_start: 2 * i }));
    return { ok: true, value: { arm, trajectory: { joint_names: arms.get(arm)?.joints, points } } as unknown as Plan };
  };
  return { asked, api: { plan } };
}

describe('Pasted goal', () => {
  it('is previewed by the path that the server would plan now', async () => {
    const { api, asked } = planner();
    const batch = read_batch('{"id": "go", "arm": "left", "move_to": {"named": "ready"}, "velocity_scaling_factor": 0.5}');
    expect(motion_of(batch)).toBeNull();
    expect(has_goal(batch, known)).toBe(true);
    const paths = await paths_to_goals(batch, known, api);
    expect(asked).toEqual([{ arm: 'left', to: { named: 'ready' }, start: undefined, velocity_scaling_factor: 0.5 }]);
    expect(paths).toMatchObject({ planned: 1, left_out: 0, problem: null });
    expect(motion_of(paths.batch)?.q_at(2)).toEqual({ left_panda_joint1: 0.3, left_panda_joint2: -1 });
  });

  it('starts where the previous job of the batch leaves its arm', async () => {
    const { api, asked } = planner();
    const batch = read_batch(JSON.stringify([
      { trajectory: { joint_names: arms.get('left')?.joints, points: [{ positions: [0, 0], time_from_start: 0 }, { positions: [1, 2], time_from_start: 1 }] } },
      { arm: 'left', move_to: { joints: [3, 4] } }, { arm: 'right', move_to: { named: 'home' } }, { arm: 'left', move_to: { named: 'ready' } },
    ]));
    const paths = await paths_to_goals(batch, known, api);
    expect(asked.map(({ start }) => start)).toEqual([{ joints: [1, 2] }, undefined, { joints: [3, 4] }]);
    expect(motion_of(paths.batch)?.q_at(3)).toMatchObject({ left_panda_joint1: 3, left_panda_joint2: 4 });
  });

  it('without a path says why, and later goals are not previewed', async () => {
    const { api } = planner();
    const batch = read_batch('[{"arm": "left", "move_to": {"joints": [9, 0]}}, {"arm": "left", "move_to": {"named": "ready"}}]');
    expect(await paths_to_goals(batch, known, api)).toMatchObject({ planned: 0, left_out: 1, problem: { title: 'No plan' } });
  });

  it('is not planned while incomplete or unknown to the cell', () => {
    for (const text of ['{"arm": "left", "move_to": ', '{"arm": "lef", "move_to": {"named": "ready"}}', '{"arm": "left", "move_to": {"named": "rea"}}',
      '{"arm": "left", "move_to": {"joints": [1]}}', '{"arm": "left", "move_to": {}}', '{"arm": "left", "move_to": {"pose": {"xyz": [1, 2]}}}', '{"arms": [], "move_to": {"named": "home"}}', '[]', '7']) {
      expect(has_goal(read_batch(text), known), text).toBe(false);
    }
    expect(has_goal(read_batch('{"arms": ["left", "right"], "move_to": {"pose": {"xyz": [0, 0.2, 0.5]}}}'), known)).toBe(true);
  });
});
