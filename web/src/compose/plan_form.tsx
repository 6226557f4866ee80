// The plan form: the server plans a path to a goal. The user can preview, check and send this path
// as a job.

import { useEffect, useRef, useState } from 'preact/hooks';
import type { Plan, Problem } from '../server/messages';
import type { App } from '../state/app';
import { millimeters, seconds, why_not_connected } from '../wording';
import { InSight } from '../frame/in_sight';
import { NumberField } from '../frame/number_field';
import { pretty } from './example';
import type { Grip } from '../view/drag_handles';
import type { ToolPose } from '../view/tool_goal';
import { arm_of, form_of_pose, plan_request, pose_of_form, states_of, type GoalForm, type GoalKind } from './goal';
import { kText } from '../strings';
import { Refused } from './refused';

const kWords = kText.plan;

type Outcome = { kind: 'none' } | { kind: 'busy' } | { kind: 'planned'; plan: Plan } | { kind: 'refused'; problem: Problem } | { kind: 'fault'; text: string };

const kAlready_s = 0.05;
const kKinds: readonly [GoalKind, string][] = [['named', kWords.named], ['joints', kWords.joints], ['pose', kWords.pose]];

// The last input. It stays when the form is closed, and is shown when the form is opened again.
let last: GoalForm | null = null;

/** `change` receives the planned job as text. */
export function PlanForm({ app, change }: { app: App; change(text: string): void }) {
  const { cell } = app.store;
  const [form, set_form] = useState<GoalForm | null>(last);
  const [outcome, set_outcome] = useState<Outcome>({ kind: 'none' });
  const turn_ = useRef(0);
  if (!cell) return null;
  const first = cell.robots.flatMap((robot) => robot.arms)[0]?.name ?? '';
  const shown = form ?? { arm: first, kind: 'named', named: 'home', joints: '', xyz: '', rpy: '180, 0, 0', link: '', speed: '50' };
  const set = (part: Partial<GoalForm>) => {
    last = { ...(last ?? shown), ...part };  // not from `form`: a drag calls the function of an older drawing
    set_form(last);
    set_outcome({ kind: 'none' });
  };
  const plan = async (form: GoalForm) => {
    const asked = plan_request(form);
    if (!asked.ok) return set_outcome({ kind: 'fault', text: asked.fault });
    set_outcome({ kind: 'busy' });
    app.ghost.value = null;
    const turn = ++turn_.current;
    const answer = await app.api.plan(asked.text);
    if (turn !== turn_.current) return;  // another path was requested meanwhile
    if (!answer.ok) {
      show_nearest(answer.problem, form.arm, app);
      return set_outcome({ kind: 'refused', problem: answer.problem });
    }
    set_outcome({ kind: 'planned', plan: answer.value });
    change(pretty({ name: name_of(form), trajectory: answer.value.trajectory }));
  };
  const drag = (part: Partial<GoalForm>) => {
    set(part);
    if (last) void plan(last);
  };
  const why_disabled = why_not_connected(app.store.link);
  const { arm } = shown;
  return (
    <form class="plan-form" data-test="plan-form" onSubmit={(event) => { event.preventDefault(); void plan(shown); }}>
      <div class="line wrap">
        <label>{kWords.arm} <select value={arm} data-test="plan-arm" onChange={(event) => set({ arm: event.currentTarget.value, named: 'home' })}>
          {[...app.store.arms.keys()].map((name) => <option key={name} value={name}>{name}</option>)}
        </select></label>
        <label>{kWords.goal} <select value={shown.kind} data-test="plan-kind" onChange={(event) => set({ kind: event.currentTarget.value as GoalKind })}>
          {kKinds.map(([kind, title]) => <option key={kind} value={kind}>{title}</option>)}
        </select></label>
        {shown.kind === 'named' && <Named form={shown} app={app} set={set} />}
        <label>{kWords.speed} <NumberField narrow value={shown.speed} step={1} test="plan-speed" change={(speed) => set({ speed })} /> {kWords.percent}</label>
      </div>
      {shown.kind !== 'named' && <Goal form={shown} app={app} set={set} />}
      {shown.kind === 'pose' && <Drag form={shown} app={app} drag={drag} />}
      <div class="line">
        <button type="submit" data-test="plan" disabled={outcome.kind === 'busy' || why_disabled !== null} title={why_disabled ?? kWords.submit_title}>
          {outcome.kind === 'busy' ? kWords.planning : kWords.submit}
        </button>
        <span class="dim small grow">{kWords.start}</span>
      </div>
      <InSight answer={outcome.kind === 'none' || outcome.kind === 'busy' ? null : outcome}>
        {outcome.kind === 'planned' && <Planned plan={outcome.plan} />}
        {outcome.kind === 'fault' && <p class="refused" role="alert" data-test="plan-fault">{outcome.text}</p>}
        {outcome.kind === 'refused' && <Unplanned problem={outcome.problem} />}
      </InSight>
    </form>
  );
}

function Named({ form, app: { store: { cell } }, set }: { form: GoalForm; app: App; set(part: Partial<GoalForm>): void }) {
  const states = cell ? states_of(arm_of(cell, form.arm)) : [];
  return (
    <label>{kWords.state} <select value={form.named} data-test="plan-named" onChange={(event) => set({ named: event.currentTarget.value })}>
      {states.map((name) => <option key={name} value={name}>{name}</option>)}
    </select></label>
  );
}

function Goal({ form, app, set }: { form: GoalForm; app: App; set(part: Partial<GoalForm>): void }) {
  const arm = app.store.arms.get(form.arm);
  const text = (key: 'joints' | 'xyz' | 'rpy' | 'link', label: string, hint: string) => (
    <label class="grow">{label}<input type="text" value={form[key]} placeholder={hint} data-test={`plan-${key}`} onInput={(event) => set({ [key]: event.currentTarget.value })} /></label>
  );
  if (form.kind === 'joints') {
    const here = arm ? app.store.q_of(arm).map((angle) => angle.toFixed(3)).join(', ') : '';
    return (
      <div class="line goal">
        {text('joints', kWords.joints_label, here)}
        <button type="button" class="small" data-test="plan-here" onClick={() => set({ joints: here })}>{kWords.current}</button>
      </div>
    );
  }
  return <div class="line wrap goal">{text('xyz', kWords.position_label, kWords.position_hint)}{text('rpy', kWords.rotation_label, kWords.rotation_hint)}{text('link', kWords.link_label, kWords.link_hint)}</div>;
}

/**
 * Lets the user drag the goal in the 3D view. On each release the new goal is entered in the form
 * and planned.
 */
function Drag({ form, app, drag }: { form: GoalForm; app: App; drag(part: Partial<GoalForm>): void }) {
  const [grip, set_grip] = useState<Grip | null>(null);
  const { arm, link, xyz, rpy } = form;
  useEffect(() => {
    const on_release = (pose: ToolPose) => drag(form_of_pose(pose));
    app.tool.value = grip && { arm, link: link.trim(), grip, at: pose_of_form({ xyz, rpy }), on_release };
  }, [app, grip, arm, link, xyz, rpy]);
  useEffect(() => () => { app.tool.value = null; }, [app]);
  const button = (its: Grip, title: string) => (
    <button type="button" class="small" data-test={`plan-${its}`} aria-pressed={grip === its} onClick={() => set_grip(grip === its ? null : its)}>{title}</button>
  );
  return (
    <div class="line wrap">
      {button('move', kWords.drag)}{button('turn', kWords.turn)}
      <span class="dim small">{grip ? kWords.drag_hint : kWords.drag_or_form}</span>
    </div>
  );
}

function Planned({ plan }: { plan: Plan }) {
  const { verdict, not_checked_reason } = plan;
  const words = verdict === undefined ? kWords.refused(not_checked_reason?.detail ?? '')
    : verdict.verdict === 'free' && !verdict.earliest_start_s ? kWords.start_now
    : verdict.earliest_start_s === null ? kWords.waits : kWords.start_in(verdict.verdict === 'free' ? kText.compose.would : kText.compose.could, seconds(verdict.earliest_start_s));
  if (plan.duration_s < kAlready_s) return <p class="planned-words" role="status" data-test="planned">{kWords.already_there}</p>;
  return (
    <p class="planned-words" role="status" data-test="planned">
      <b>{seconds(plan.duration_s)}</b>{kWords.certified}{plan.straight_line_length > 0 && kWords.longer(Math.max(0, Math.round(100 * (plan.length / plan.straight_line_length - 1))))}. {words}
    </p>
  );
}

function Unplanned({ problem }: { problem: Problem }) {
  const { links, clearance_m, nearest } = problem;
  return (
    <>
      <Refused problem={problem} />
      {links?.length === 2 && clearance_m !== undefined && <p class="small">{clearance_m <= 0 ? kWords.in_contact(links[0] ?? '', links[1] ?? '') : kWords.apart(links[0] ?? '', links[1] ?? '', millimeters(clearance_m))}</p>}
      {nearest && <p class="small">{kWords.nearest}</p>}
    </>
  );
}

/** If planning failed, shows the nearest configuration as a ghost. */
function show_nearest(problem: Problem, arm: string, app: App): void {
  const joints = app.store.arms.get(arm)?.joints ?? [];
  if (problem.nearest?.length !== joints.length) return;
  app.ghost.value = Object.fromEntries(joints.map((joint, i) => [joint, problem.nearest?.[i] ?? 0]));
}

function name_of(form: GoalForm): string {
  if (form.kind === 'named') return kWords.job_name(form.arm, form.named);
  return form.kind === 'pose' ? kWords.job_name(form.arm, form.xyz) : kWords.job_name(form.arm, kWords.joints_goal);
}
