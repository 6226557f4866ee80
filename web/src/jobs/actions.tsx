// Commands for an unfinished job. They are in the job's row and on its page.

import { use_question } from '../frame/question';
import { kCanReplan, type Job } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { is_terminal } from '../state/job_book';
import { kText } from '../strings';
import { shown_name, shown_text } from '../names';
import { object_of, title_of } from '../wording';

const kWords = kText.job;

interface Props { job: Job; app: App }

/** True if an object of the scene blocks the job, so that a user can move it. */
export function is_blocked_by_object(job: Job, { store }: App): boolean {
  const name = is_terminal(job) ? null : object_of(job);
  return name !== null && store.objects.some((object) => object.name === name);
}

/** The commands that help a job that an object blocks: move the object, plan another path, cancel. */
export function WaysOn({ job, app }: Props) {
  return (
    <div class="ways-on" data-test="ways-on">
      <MoveObject job={job} app={app} />
      {kCanReplan && job.arms.length === 1 && <Replan job={job} app={app} words={kWords.another_path} />}
      <Cancel job={job} app={app} words={kWords.cancel_blocked} />
      {job.replan?.planning && <span class="small" role="status">{kWords.planning}</span>}
      {job.replan && !job.replan.planning && job.replan.refused !== null && <span class="small no-way" role="status" data-test="no-other-path">{kWords.no_other_path(shown_text(job.replan.refused))}</span>}
    </div>
  );
}

function MoveObject({ job, app }: Props) {
  const name = object_of(job) ?? '';
  const why_disabled = why_no_command(app);
  return (
    <button class="small" data-test="move-blocker" disabled={why_disabled !== null} title={why_disabled ?? kWords.move_object_title(shown_name(name))}
      onClick={() => {
        app.router.go({ page: 'scene', name });
        app.dragged_object.value = name;
      }}>{kWords.move_object(shown_name(name))}</button>
  );
}

/** All commands for a job, as shown on its page. */
export function JobActions({ job, app }: Props) {
  if (is_terminal(job)) return null;
  if (is_blocked_by_object(job, app)) return <div class="job-actions" data-test="job-actions">{waits(job) && <Urgency job={job} app={app} />}<WaysOn job={job} app={app} /></div>;
  return (
    <div class="job-actions" data-test="job-actions">
      {waits(job) && <Urgency job={job} app={app} />}
      {kCanReplan && job.arms.length === 1 && <Replan job={job} app={app} />}
      <Cancel job={job} app={app} words={kWords.cancel_this} />
    </div>
  );
}

export function waits(job: Pick<Job, 'state'>): boolean {
  return job.state === 'queued' || job.state === 'backlogged';
}

/** Buttons that raise or lower the priority of a waiting job. */
export function Urgency({ job, app }: Props) {
  const why_disabled = why_no_command(app);
  const step = (by: number, sign: string, what: string) => (
    <button class="small" disabled={why_disabled !== null} title={why_disabled ?? kWords.new_priority(what, job.priority + by)} aria-label={kWords.of_job(what, job.id)}
      onClick={() => { void app.actions.set_priority(job.id, job.priority + by); }}>{sign}</button>
  );
  return <div class="urgency" data-test="urgency">{step(1, '▲', kWords.more_urgent)}{step(-1, '▼', kWords.less_urgent)}</div>;
}

/** The cancel button. It asks for confirmation first. */
export function Cancel({ job, app, words }: Props & { words?: string }) {
  const question = use_question();
  const why_disabled = why_no_command(app);
  if (!question.asked) {
    return (
      <button ref={question.button} class={words === undefined ? 'cancel' : 'small'} data-test={words === undefined ? 'cancel-row' : 'cancel-job'} disabled={app.store.is_braking(job) || why_disabled !== null} title={why_disabled ?? kWords.cancel(job.id)}
        aria-label={kWords.cancel(job.id)} onClick={question.ask}>{words ?? kWords.cancel_short}</button>
    );
  }
  const moves = job.state === 'running' || job.state === 'paused';
  return (
    <div class="confirm" role="alertdialog" aria-label={kWords.cancel_question(job.id)} onKeyDown={(event) => { if (event.key === 'Escape') { event.stopPropagation(); question.take_back(); } }}>
      <span>{moves ? kWords.brakes(title_of(job)) : kWords.cancel_question(title_of(job))}</span>
      <button class="small danger" data-test="confirm-cancel" ref={(button) => button?.focus()} onClick={() => { question.end(); void app.actions.cancel(job.id); }}>{kWords.confirm_cancel}</button>
      <button class="small" onClick={question.take_back}>{kText.common.keep}</button>
    </div>
  );
}

/**
 * The button that replans the job. For a moving job it asks for confirmation, because the rest of
 * the job's trajectory is discarded.
 */
function Replan({ job, app, words = kWords.replan }: Props & { words?: string }) {
  const { asked, ...question } = use_question();
  const why_disabled = why_no_command(app);
  const moves = job.state === 'running' || job.state === 'paused';
  const ask = () => {
    if (moves && !asked) return question.ask();
    question.end();
    void app.actions.replan(job.id);
  };
  return (
    <div class="line">
      <button ref={question.button} class="small" data-test="replan" disabled={why_disabled !== null || app.store.is_braking(job)} title={why_disabled ?? kWords.replan_title} onClick={ask}>
        {asked ? kWords.confirm_replan : words}
      </button>
      {asked && <><span class="small">{kWords.replan_loss}</span><button class="small" onClick={question.take_back}>{kWords.keep_path}</button></>}
    </div>
  );
}
