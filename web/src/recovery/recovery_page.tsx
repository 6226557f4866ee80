// After a stop: why the arms stopped, what each of them needs, what to look at before they move again,
// and the way back.

import { StatePill } from '../arms/arms';
import { AsOf } from '../frame/as_of';
import { Cancel } from '../jobs/actions';
import { Link } from '../route/link';
import type { Arm } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { arm_colour } from '../state/palette';
import { instant_of, pose_at } from '../state/instant';
import { use_beats } from '../state/seen';
import { clock, title_of } from '../wording';
import { kChecks } from './checklist';
import { cause_of, need_of, waiting_arms } from './needs';
import { shown_name, shown_text } from '../names';

const kHomeSpeed = 0.3;

export function RecoveryPage({ app }: { app: App }) {
  const { store } = app;
  const arms = [...store.arms.values()];
  const waiting = waiting_arms(store);
  const cause = cause_of(store.events);
  const looks_back = app.router.address.value.t_s !== null;
  return (
    <div class="page" data-test="recovery">
      <h2>Recovery</h2>
      <AsOf app={app}>Arms are resumed from the present alone.</AsOf>
      <p class={cause || waiting.length > 0 ? 'words' : 'hint'} data-test="cause">{cause ? <><span class="mono">{clock(cause.t_s)}</span> {shown_text(cause.text)}</> : waiting.length > 0 ? 'The arms were stopped before this page listened.' : looks_back ? 'As far as this page knows no arm had been stopped by then.' : 'As far as this page knows no arm has been stopped.'}</p>
      <p class="hint">{waiting_in_words(waiting.length, arms.length, looks_back)}{' '}
        <Link app={app} to={{ page: 'alerts' }}>Alerts</Link></p>
      {!looks_back && <><h3>1. Look</h3><Checks app={app} needed={waiting.length > 0} /></>}
      <h3>{looks_back ? 'What each arm needed' : '2. What each arm needs'}</h3>
      <ul class="needs">{arms.map((arm) => <Needs key={arm.name} arm={arm} app={app} guarded={waiting.length > 0 && app.checklist.left > 0} />)}</ul>
    </div>
  );
}

function waiting_in_words(waiting: number, arms: number, looks_back: boolean): string {
  if (looks_back) return waiting === 0 ? 'No arm waited to be resumed.' : `${waiting} of ${arms} arms stood until they would be resumed.`;
  return waiting === 0 ? 'No arm waits to be resumed.' : `${waiting} of ${arms} arms stand until they are resumed.`;
}

function Checks({ app, needed }: { app: App; needed: boolean }) {
  const { checklist } = app;
  const { left } = checklist;
  const mute = why_no_command(app);
  return (
    <fieldset class="checks">
      <legend class="sr-only">Before the arms move again</legend>
      {kChecks.map((text, i) => (
        <label key={i} class="check">
          <input type="checkbox" data-test={`check-${i}`} disabled={!needed} checked={checklist.is_ticked(i)} onChange={(event) => checklist.tick(i, event.currentTarget.checked)} /> {text}
        </label>
      ))}
      <div class="line">
        <button class="primary" data-test="resume-checked" disabled={!needed || left > 0 || mute !== null} title={mute ?? ''}
          onClick={(event) => { if (event.detail < 2) void app.actions.resume(); /* not by the second click of a double one */ }}>Resume all arms</button>
        <span class="dim small" role="status" data-test="checks-left">{!needed ? 'Nothing is stopped.' : left > 0 ? `${left} still to confirm.` : 'They go on with their jobs as soon as their ways are free.'}</span>
      </div>
    </fieldset>
  );
}

/** `guarded`: no arm moves before all has been looked at. */
function Needs({ arm, app, guarded }: { arm: Arm; app: App; guarded: boolean }) {
  use_beats(app.store);
  const { store } = app;
  const job = arm.job === null ? null : store.job(arm.job);
  const next = store.next_of(arm.name);
  const its = job ?? next;
  const need = need_of(arm, job, pose_at(instant_of(app.router.address.value, store), store), next);
  const mute = why_no_command(app) ?? (guarded ? 'First confirm the list above' : null);
  return (
    <li data-test={`need-${arm.name}`} style={{ '--arm': arm_colour([...store.arms.keys()], arm.name) }}>
      <div class="line"><span class="swatch" aria-hidden="true" /><Link app={app} to={{ page: 'arm', name: arm.name }}>{shown_name(arm.name)}</Link><StatePill arm={arm} app={app} /></div>
      <p>{need.words}</p>
      <div class="line">
        {need.resume && <button class="small" data-test={`resume-${arm.name}`} disabled={mute !== null} title={mute ?? ''} onClick={() => void app.actions.resume_arm(arm.name)}>Resume {shown_name(arm.name)} alone</button>}
        {need.resume && its && <Link app={app} to={{ page: 'job', id: its.id }}>{job ? 'Its job' : 'Its next job'}</Link>}
        {need.resume && its && <Cancel job={its} app={app} words={`Cancel ${title_of(its)}`} />}
        {need.home && <button class="small" data-test={`home-${arm.name}`} disabled={mute !== null} title={mute ?? ''} onClick={() => void app.actions.send_to(arm.name, 'home', kHomeSpeed)}>Send {shown_name(arm.name)} home, slowly</button>}
      </div>
    </li>
  );
}
