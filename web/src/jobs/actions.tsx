// Commands for an unfinished job. They are in the job's row and on its page.

import { use_question } from '../frame/question';
import { kCanReplan, type Job } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { is_terminal } from '../state/job_book';
import { kText } from '../strings';
import { title_of } from '../wording';

const kWords = kText.job;

interface Props { job: Job; app: App }

/** All commands for a job, as shown on its page. */
export function JobActions({ job, app }: Props) {
  if (is_terminal(job)) return null;
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
      <button ref={question.button} class={words === undefined ? 'cancel' : 'small'} data-test={words === undefined ? undefined : 'cancel-job'} disabled={job.stopping || why_disabled !== null} title={why_disabled ?? kWords.cancel(job.id)}
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
function Replan({ job, app }: Props) {
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
      <button ref={question.button} class="small" data-test="replan" disabled={why_disabled !== null || job.stopping} title={why_disabled ?? kWords.replan_title} onClick={ask}>
        {asked ? kWords.confirm_replan : kWords.replan}
      </button>
      {asked && <><span class="small">{kWords.replan_loss}</span><button class="small" onClick={question.take_back}>{kWords.keep_path}</button></>}
    </div>
  );
}
