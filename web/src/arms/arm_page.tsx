// The page of one arm: current and next jobs, joints with limits, what its controller promises, and a
// plot of the last seconds.

import { useState } from 'preact/hooks';
import { arm_of, states_of } from '../compose/goal';
import { JogPanel } from '../control/jog';
import { AsOf } from '../frame/as_of';
import { step_in_words } from '../jobs/steps';
import { when_in_words } from '../jobs/when';
import { Link } from '../route/link';
import { Plot, units_of } from '../plot/plot';
import { range_of, type Arm, type CellJoint } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { arm_color } from '../state/palette';
import { instant_of, pose_at } from '../state/instant';
import { is_halted } from '../state/shown_state';
import { seen_app } from '../state/as_of';
import { use_beats } from '../state/seen';
import { known_lanes } from '../timeline/known';
import { lane_in_words } from '../timeline/mark_words';
import { short_names, shown_name } from '../names';
import { promises_in_words, reason_in_words, title_of } from '../wording';
import { kText } from '../strings';
import { ArmNotes, Holds, StatePill } from './arms';

const kWords = kText.arm;

const kPlotted_s = 20;
const kSlowly = 0.3;

export function ArmPage({ name, app }: { name: string; app: App }) {
  const { store } = app;
  const arm = store.arms.get(name);
  if (!arm) return <><h2>{shown_name(name)}</h2><p class="hint">{store.stream === null ? kText.common.not_connected : kWords.unknown}</p></>;
  const then = seen_app(app);
  const arm_then = then.store.arms.get(name) ?? arm;
  const job = then.store.job_of(arm_then);
  const step = job && step_in_words(job, true);
  const waiting = then.store.arm_state(arm_then) === 'waiting' ? then.store.waiting_of(name) : null;
  const nothing = then.store.arm_state(arm_then) === 'not known' ? kWords.past_unknown : then === app ? kWords.no_active_job : kWords.no_job_was_active;
  const color = arm_color([...store.arms.keys()], name);
  return (
    <div class="page" style={{ '--arm': color }}>
      <div class="line">
        <h2 class="ellipsis"><span class="swatch" aria-hidden="true" /> {shown_name(name)}</h2>
        <StatePill arm={arm_then} app={then} />
        <span class="grow" />
        <StopOfArm arm={arm} app={app} />
      </div>
      <ArmNotes arm={arm_then} />
      <p class="hint">
        {job ? <>{then === app ? kWords.executes : kWords.executed} <Link app={app} to={{ page: 'job', id: job.id }}>{title_of(job)}</Link>{step !== null && `, ${step}`}</> : waiting ? <>{kWords.next} <Link app={app} to={{ page: 'job', id: waiting.id }}>{title_of(waiting)}</Link>: {reason_in_words(waiting)}{when_in_words(waiting, then.store) !== '' && `; ${when_in_words(waiting, then.store)}`}</> : nothing}
      </p>
      <Holds arm={name} app={then} in_sentence />
      <AsOf app={app}>{kWords.acts_now}</AsOf>
      <SendTo arm={arm} app={app} />
      <JogPanel arm={arm} app={app} />
      <h3>{kWords.joints}</h3>
      <Joints arm={arm} app={app} />
      <Controller arm={arm} app={app} />
      <h3>{kWords.measured(units_of(arm.joints, app), kPlotted_s)}</h3>
      <Plot app={app} joints={arm.joints} last_s={kPlotted_s} label={kWords.measured_label(name)} />
      <h3>{kWords.schedule}</h3>
      <Coming name={name} app={app} />
    </div>
  );
}

function StopOfArm({ arm, app }: { arm: Arm; app: App }) {
  const why_disabled = why_no_command(app);
  return is_halted(arm)
    ? <button class="small" data-test="resume-arm" title={kText.common.open_recovery} onClick={() => app.router.go({ page: 'recovery' })}>{kText.common.resume}</button>
    : <button class="small" disabled={why_disabled !== null} data-test="stop-arm" title={kWords.stop_title} onClick={() => void app.actions.stop_arm(arm.name)}>{kWords.stop}</button>;
}

/** Sends the arm to a named state. The server plans the path; the job is queued like any other. */
function SendTo({ arm, app }: { arm: Arm; app: App }) {
  const { cell } = app.store;
  const states = cell ? states_of(arm_of(cell, arm.name)) : [];
  const [state, set_state] = useState('home');
  const why_disabled = why_no_command(app);
  return (
    <div class="line wrap">
      <label class="line">{kWords.send_to} <select value={state} data-test="send-state" onChange={(event) => set_state(event.currentTarget.value)}>
        {states.map((name) => <option key={name} value={name}>{name}</option>)}
      </select></label>
      <button class="small" data-test="send-there" disabled={why_disabled !== null} title={why_disabled ?? kWords.send_title}
        onClick={() => void app.actions.send_to(arm.name, state, kSlowly)}>{kWords.send(100 * kSlowly)}</button>
      <Link app={app} to={{ page: 'new' }}>{kWords.other_goals}</Link>
    </div>
  );
}

function Coming({ name, app }: { name: string; app: App }) {
  const lane = known_lanes(app).find((known) => known.arm === name);
  return <ul class="plain">{(lane ? lane_in_words(lane, app.store.t_s) : []).map((words, i) => <li key={i}>{words}</li>)}</ul>;
}

function Joints({ arm, app }: { arm: Arm; app: App }) {
  use_beats(app.store);
  const at = pose_at(instant_of(app.router.address.value, app.store), app.store);
  if (at === null) return <p class="hint" data-test={`joints-${arm.name}`}>{kWords.joints_unknown}</p>;
  const q = arm.joints.map((joint, i) => at[joint] ?? arm.q[i] ?? 0);
  const limits = new Map(app.store.cell?.joints.map((joint) => [joint.name, joint]));
  const titles = short_names(arm.joints);
  return (
    <table class="joints" data-test={`joints-${arm.name}`}>
      <thead><tr>{[kWords.joint, kWords.lower, kWords.position, kWords.upper, kWords.measured_column].map((title) => <th key={title} scope="col">{title}</th>)}</tr></thead>
      <tbody>{arm.joints.map((name, i) => <Joint key={name} name={name} title={titles[i] ?? name} value={q[i] ?? 0} joint={limits.get(name)} />)}</tbody>
    </table>
  );
}

function Controller({ arm, app }: { arm: Arm; app: App }) {
  const robot = app.store.cell?.robots.find(({ arms }) => arms.some(({ name }) => name === arm.name));
  if (!robot) return null;
  const measured = app.router.address.value.t_s === null ? arm : null;
  return (
    <>
      <h3>{kWords.controller}</h3>
      <dl class="facts-list" data-test="controller">
        {promises_in_words(robot.controller, units_of(arm.joints, app), measured).map(([what, value]) => <div key={what}><dt>{what}</dt><dd>{value}</dd></div>)}
      </dl>
    </>
  );
}

const kNear = 0.05;

function Joint({ name, title, value, joint }: { name: string; title: string; value: number; joint: CellJoint | undefined }) {
  const [lower, upper] = joint ? range_of(joint) : [-Infinity, Infinity];
  const bounded = Number.isFinite(upper - lower);
  const [from, to] = bounded ? [lower, upper] : [-Math.PI, Math.PI];
  const share = Math.min(1, Math.max(0, (value - from) / (to - from)));
  const near = bounded && (share < kNear || share > 1 - kNear);
  const figure = (limit: number) => (Number.isFinite(limit) ? limit.toFixed(2) : kWords.no_limit);
  return (
    <tr class={near ? 'near' : ''}>
      <th scope="row" title={name}>{title}</th>
      <td class="mono dim">{figure(lower)}</td>
      <td><span class="gauge"><span style={{ left: `${100 * share}%` }} /></span></td>
      <td class="mono dim">{figure(upper)}</td>
      <td class="mono"><span class="whole">{value.toFixed(3)} {joint?.unit ?? ''}</span>{near ? kWords.near_limit : ''}</td>
    </tr>
  );
}
