// The Recovery page after a stop: the cause, the checklist, what each arm needs, and Resume.

import { ArmNotes, Holds, StatePill } from '../arms/arms';
import { AsOf } from '../frame/as_of';
import { Cancel } from '../jobs/actions';
import { Link } from '../route/link';
import type { Arm } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { arm_color } from '../state/palette';
import { instant_of, pose_at } from '../state/instant';
import { use_beats } from '../state/seen';
import { clock, title_of } from '../wording';
import { LetGo } from '../scene/let_go';
import { kChecks } from './checklist';
import { cause_of, need_of, waiting_arms } from './needs';
import { shown_name, shown_text } from '../names';
import { kText } from '../strings';

const kWords = kText.recovery;

const kHomeSpeed = 0.3;

export function RecoveryPage({ app }: { app: App }) {
  const { store } = app;
  const arms = [...store.arms.values()];
  const waiting = waiting_arms(store);
  const cause = cause_of(store.events);
  const looks_back = app.router.address.value.t_s !== null;
  return (
    <div class="page" data-test="recovery">
      <h2>{kText.page.recovery}</h2>
      <AsOf app={app}>{kWords.live_only}</AsOf>
      <p class={cause || waiting.length > 0 ? 'words' : 'hint'} data-test="cause">{cause ? <><span class="mono">{clock(cause.t_s)}</span> {shown_text(cause.text)}</> : waiting.length > 0 ? kWords.stopped_before : looks_back ? kWords.no_stop_then : kWords.no_stop}</p>
      <p class="hint">{waiting_in_words(waiting.length, arms.length, looks_back)}{' '}
        <Link app={app} to={{ page: 'alerts' }}>{kText.page.alerts}</Link></p>
      {!looks_back && <><h3>{kWords.check_first}</h3><Checks app={app} needed={waiting} /></>}
      <h3>{looks_back ? kWords.needs_then : kWords.needs}</h3>
      <ul class="needs">{arms.map((arm) => <Needs key={arm.name} arm={arm} app={app} guarded={waiting.length > 0 && app.checklist.left > 0} />)}</ul>
    </div>
  );
}

function waiting_in_words(waiting: number, arms: number, looks_back: boolean): string {
  if (looks_back) return waiting === 0 ? kWords.none_waited : kWords.waited(waiting, arms);
  return waiting === 0 ? kWords.none_waits : kWords.waiting(waiting, arms);
}

function Checks({ app, needed }: { app: App; needed: readonly Arm[] }) {
  const { checklist } = app;
  const { left } = checklist;
  const why_disabled = why_no_command(app) ?? (needed.length > 0 && needed.every(({ link }) => link === 'lost') ? kWords.no_link : null);
  return (
    <fieldset class="checks">
      <legend class="sr-only">{kWords.legend}</legend>
      {kChecks.map((text, i) => (
        <label key={i} class="check">
          <input type="checkbox" data-test={`check-${i}`} disabled={needed.length === 0} checked={checklist.is_ticked(i)} onChange={(event) => checklist.tick(i, event.currentTarget.checked)} /> {text}
        </label>
      ))}
      <div class="line">
        <button class="primary" data-test="resume-checked" disabled={needed.length === 0 || left > 0 || why_disabled !== null} title={why_disabled ?? ''}
          onClick={(event) => { if (event.detail < 2) void app.actions.resume(); /* ignores the second click of a double click */ }}>{kWords.resume_all}</button>
        <span class="dim small" role="status" data-test="checks-left">{needed.length === 0 ? kWords.nothing_stopped : left > 0 ? kWords.still_to_confirm(left) : why_disabled ?? kWords.after_resume}</span>
      </div>
    </fieldset>
  );
}

/**
 * Shows what one arm needs. `guarded` disables the buttons that cause motion, until the checklist
 * is confirmed.
 */
function Needs({ arm, app, guarded }: { arm: Arm; app: App; guarded: boolean }) {
  use_beats(app.store);
  const { store } = app;
  const job = store.job_of(arm);
  const next = store.next_of(arm.name);
  const its = job ?? next;
  const need = need_of(arm, job, pose_at(instant_of(app.router.address.value, store), store), next);
  const why_disabled = why_no_command(app) ?? (guarded ? kWords.confirm_first : null);
  const why_no_resume = arm.link === 'lost' ? kWords.no_link : why_disabled;
  return (
    <li data-test={`need-${arm.name}`} style={{ '--arm': arm_color([...store.arms.keys()], arm.name) }}>
      <div class="line"><span class="swatch" aria-hidden="true" /><Link app={app} to={{ page: 'arm', name: arm.name }}>{shown_name(arm.name)}</Link><StatePill arm={arm} app={app} /></div>
      <ArmNotes arm={arm} />
      <p>{need.words}</p>
      <Holds arm={arm.name} app={app} in_sentence />
      {app.router.address.value.t_s === null && job === null && store.holds(arm.name).map((object) => <LetGo key={object} object={object} arm={arm.name} app={app} />)}
      <div class="line">
        {need.resume && <button class="small" data-test={`resume-${arm.name}`} disabled={why_no_resume !== null} title={why_no_resume ?? ''} onClick={() => void app.actions.resume_arm(arm.name)}>{kWords.resume_one(shown_name(arm.name))}</button>}
        {need.resume && its && <Link app={app} to={{ page: 'job', id: its.id }}>{job ? kWords.its_job : kWords.its_next_job}</Link>}
        {need.resume && its && <Cancel job={its} app={app} words={kText.job.cancel(title_of(its))} />}
        {need.home && <button class="small" data-test={`home-${arm.name}`} disabled={why_disabled !== null} title={why_disabled ?? ''} onClick={() => void app.actions.send_to(arm.name, 'home', kHomeSpeed)}>{kWords.send_home(shown_name(arm.name))}</button>}
      </div>
    </li>
  );
}
