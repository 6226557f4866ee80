// The goal in the plan form. Numbers stay text until the request is made. Pure.

import { no_number, number_in } from '../frame/number_text';
import type { Cell, CellArm } from '../server/messages';
import { kText } from '../strings';
import type { ToolPose } from '../view/tool_goal';

const kWords = kText.plan;

export type GoalKind = 'named' | 'joints' | 'pose';
export interface GoalForm { arm: string; kind: GoalKind; named: string; joints: string; xyz: string; rpy: string; link: string; speed: string }

export function arm_of(cell: Cell, name: string): CellArm | undefined {
  return cell.robots.flatMap((robot) => robot.arms).find((arm) => arm.name === name);
}

/** Returns the named states of the arm; `home` is always among them. */
export function states_of(arm: CellArm | undefined): string[] {
  return ['home', ...Object.keys(arm?.named_states ?? {}).filter((name) => name !== 'home')];
}

/** Returns the body of POST /plan, or what is wrong with the form. */
export function plan_request(form: GoalForm): { ok: true; text: string } | { ok: false; fault: string } {
  const speed = number_in(form.speed);
  if (speed === null) return { ok: false, fault: kWords.speed_fault(no_number(form.speed)) };
  if (!(speed > 0 && speed <= 100)) return { ok: false, fault: kWords.speed_range(form.speed) };
  const to = goal_of(form);
  if (typeof to === 'string') return { ok: false, fault: to };
  return { ok: true, text: JSON.stringify({ arm: form.arm, to, velocity_scaling_factor: speed / 100 }) };
}

function goal_of(form: GoalForm): object | string {
  if (form.kind === 'named') return { named: form.named };
  if (form.kind === 'joints') {
    const joints = numbers_in(form.joints);
    return joints ? { joints } : kWords.joints_fault(form.joints);
  }
  const xyz = numbers_in(form.xyz);
  const rpy = numbers_in(form.rpy);
  if (xyz?.length !== 3) return kWords.position_fault(form.xyz);
  if (rpy?.length !== 3) return kWords.rotation_fault(form.rpy);
  const radians = rpy.map((angle) => (angle * Math.PI) / 180);
  return { pose: { ...(form.link.trim() === '' ? {} : { link: form.link.trim() }), xyz, rpy: radians } };
}

/**
 * Formats a pose for the form. Lengths are rounded to millimeters, angles to tenths of a degree.
 */
export function form_of_pose({ xyz, rpy }: ToolPose): Pick<GoalForm, 'xyz' | 'rpy'> {
  const text = (numbers: readonly number[], digits: number) => numbers.map((n) => String(Number(n.toFixed(digits)))).join(', ');
  return { xyz: text(xyz, 3), rpy: text(rpy.map((angle) => (angle * 180) / Math.PI), 1) };
}

/** Returns the pose, or null if the form is incomplete. */
export function pose_of_form({ xyz, rpy }: Pick<GoalForm, 'xyz' | 'rpy'>): ToolPose | null {
  const at = numbers_in(xyz);
  const turn = numbers_in(rpy)?.map((angle) => (angle * Math.PI) / 180);
  if (at?.length !== 3 || turn?.length !== 3) return null;
  return { xyz: at as ToolPose['xyz'], rpy: turn as ToolPose['rpy'] };
}

/** Reads numbers separated by commas or blanks. Returns null if any part is not a number. */
export function numbers_in(text: string): number[] | null {
  const parts = text.replaceAll(/[[\]]/g, ' ').split(/[\s,;]+/).filter((part) => part !== '');
  const numbers = parts.map(Number);
  return parts.length > 0 && numbers.every(Number.isFinite) ? numbers : null;
}
