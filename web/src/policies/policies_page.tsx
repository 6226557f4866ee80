// The Policies page: the active policy, and the comparison of all policies on recent jobs.

import { useEffect } from 'preact/hooks';
import { AsOf } from '../frame/as_of';
import { InSight } from '../frame/in_sight';
import { PolicyForm } from '../frame/policy_form';
import { why_no_change } from './change';
import type { Comparison, PolicyRun } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { kText } from '../strings';
import { clock, millimeters, seconds, why_not_connected } from '../wording';
import { ends_in_words, share_in_words } from './run_words';

const kWords = kText.policies;

export function PoliciesPage({ app }: { app: App }) {
  const { comparing } = app;
  // Polls only a comparison that the page knows. The user must click to look for one on the server.
  useEffect(() => { if (comparing.latest.peek() !== null) void comparing.look(); }, [comparing]);
  return (
    <div class="columns policies">
      <section>
        <h2>{kWords.title}</h2>
        <AsOf app={app}>{kWords.compared_now}</AsOf>
        <PolicyForm app={app} />
      </section>
      <section>
        <h2>{kWords.comparison}</h2>
        <Asking app={app} />
        {comparing.latest.value && <Table comparison={comparing.latest.value} app={app} />}
      </section>
    </div>
  );
}

function Asking({ app }: { app: App }) {
  const { comparing, store } = app;
  const unheard = why_not_connected(store.link);
  const why_disabled = why_no_command(app);
  const latest = comparing.latest.value;
  const is_running = latest?.state === 'running';
  return (
    <>
      <p class="hint">
        {kWords.hint}<code>armloom compare</code>.
      </p>
      <div class="line wrap">
        {is_running
          ? <button class="small" data-test="cancel-comparison" onClick={() => void comparing.cancel()}>{kWords.cancel}</button>
          : <button class="small" data-test="compare" disabled={why_disabled !== null} title={why_disabled ?? kWords.compare_title} onClick={() => void comparing.start(null)}>{kWords.compare}</button>}
        {latest === null && <button class="small" data-test="look-comparison" disabled={unheard !== null} title={unheard ?? kWords.show_last_title} onClick={() => void comparing.look()}>{kWords.show_last}</button>}
        <span class="dim small grow" role="status" data-test="comparison-state">{latest ? state_in_words(latest) : comparing.none_made.value ? kWords.if_empty : ''}</span>
      </div>
      <InSight answer={comparing.refusal.value}>{comparing.refusal.value !== null && <p class="refused" role="alert" data-test="comparison-refused">{comparing.refusal.value}</p>}</InSight>
    </>
  );
}

function state_in_words({ state, jobs, first_s, last_s, policies, runs, detail }: Comparison): string {
  const what = kWords.jobs_between(jobs, clock(first_s), clock(last_s));
  switch (state) {
    case 'running': return kWords.running(what, runs.length, policies.length, policies[runs.length] ?? '');
    case 'done': return kWords.done(what);
    case 'canceled': return kWords.canceled(what);
    case 'failed': return kWords.failed(what, detail);
  }
}

function Table({ comparison, app }: { comparison: Comparison; app: App }) {
  const longest_s = Math.max(...comparison.runs.map(({ makespan_s }) => makespan_s ?? 0), 1e-9);
  if (comparison.runs.length === 0) return null;
  return (
    <div class="scrolling" tabIndex={0} role="region" aria-label={kWords.table}>
      <table class="compared" data-test="compared">
        <thead><tr>
          {kWords.columns.map((title) => <th key={title} scope="col">{title}</th>)}
        </tr></thead>
        <tbody>{comparison.runs.map((run) => <Run key={run.policy} run={run} jobs={comparison.jobs} longest_s={longest_s} app={app} />)}</tbody>
      </table>
    </div>
  );
}

function Run({ run, jobs, longest_s, app }: { run: PolicyRun; jobs: number; longest_s: number; app: App }) {
  const { store, actions } = app;
  const why_disabled = why_no_command(app) ?? why_no_change(store);
  const is_in_force = run.policy === store.policy;
  const ends = ends_in_words(run);
  return (
    <tr class={is_in_force ? 'in-force' : ''} data-test={`compared-${run.policy}`}>
      <th scope="row">{run.policy}</th>
      <td class="mono">{kWords.of(run.succeeded, jobs)}{ends !== '' && <span class="dim"> ({ends})</span>}</td>
      <td class="mono">{run.backlogged}</td>
      <td class="mono">
        {run.makespan_s === null ? kWords.not_finished : seconds(run.makespan_s)}
        <span class="share" aria-hidden="true"><span style={{ width: `${(100 * (run.makespan_s ?? 0)) / longest_s}%` }} /></span>
      </td>
      <td class="mono">{share_in_words(run.makespan_ratio)}</td>
      <td class="mono">{seconds(run.wait_mean_s)}</td>
      <td class="mono">{run.min_clearance_m === null ? kWords.never_near : millimeters(run.min_clearance_m)}</td>
      <td>{is_in_force
        ? <span class="dim">{kWords.in_force}</span>
        : <button class="small" data-test={`use-${run.policy}`} disabled={why_disabled !== null} aria-label={kWords.change_to(run.policy)}
          title={why_disabled ?? ''} onClick={() => void actions.change_policy(run.policy)}>{kWords.use}</button>}</td>
    </tr>
  );
}
