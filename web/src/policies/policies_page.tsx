// Policies: which one decides, and what the jobs at hand would have come to under the others.

import { useEffect } from 'preact/hooks';
import { AsOf } from '../frame/as_of';
import { InSight } from '../frame/in_sight';
import { PolicyForm } from '../frame/policy_form';
import { why_no_change } from './change';
import type { Comparison, PolicyRun } from '../server/messages';
import type { App } from '../state/app';
import { why_no_command } from '../state/permission';
import { clock, millimetres, seconds , why_mute } from '../wording';
import { ends_in_words, share_in_words } from './told';

export function PoliciesPage({ app }: { app: App }) {
  const { comparing } = app;
  // One that is known of is looked at again; whether there is one is only asked by who wants to know.
  useEffect(() => { if (comparing.latest.peek() !== null) void comparing.look(); }, [comparing]);
  return (
    <div class="columns policies">
      <section>
        <h2>The policy</h2>
        <AsOf app={app}>The comparison beside it is of now.</AsOf>
        <PolicyForm app={app} />
      </section>
      <section>
        <h2>What would the others have done?</h2>
        <Asking app={app} />
        {comparing.latest.value && <Table comparison={comparing.latest.value} app={app} />}
      </section>
    </div>
  );
}

function Asking({ app }: { app: App }) {
  const { comparing, store } = app;
  const unheard = why_mute(store.link);
  const mute = why_no_command(app);
  const latest = comparing.latest.value;
  const is_running = latest?.state === 'running';
  return (
    <>
      <p class="hint">
        The jobs that came since the server was started, the last 500 at most, each at its time, run under every policy: simulated
        beside the cell, without stops, faults and what people canceled. Nothing in the cell changes or waits for it. Of former
        runs of the server it knows no job: <code>armloom compare</code> takes those of a recording.
      </p>
      <div class="line wrap">
        {is_running
          ? <button class="small" data-test="cancel-comparison" onClick={() => void comparing.cancel()}>Give up</button>
          : <button class="small" data-test="compare" disabled={mute !== null} title={mute ?? 'Runs in the background'} onClick={() => void comparing.start(null)}>Compare</button>}
        {latest === null && <button class="small" data-test="look-comparison" disabled={unheard !== null} title={unheard ?? 'That another page has asked for'} onClick={() => void comparing.look()}>Show the last one</button>}
        <span class="dim small grow" role="status" data-test="comparison-state">{latest ? state_in_words(latest) : comparing.none_made.value ? 'No comparison was made so far.' : ''}</span>
      </div>
      <InSight answer={comparing.refusal.value}>{comparing.refusal.value !== null && <p class="refused" role="alert" data-test="comparison-refused">{comparing.refusal.value}</p>}</InSight>
    </>
  );
}

function state_in_words({ state, jobs, first_s, last_s, policies, runs, detail }: Comparison): string {
  const what = `${jobs} ${jobs === 1 ? 'job' : 'jobs'} of ${clock(first_s)} to ${clock(last_s)}`;
  switch (state) {
    case 'running': return `${what}: ${runs.length} of ${policies.length} policies done, ${policies[runs.length] ?? ''} under way`;
    case 'done': return `${what}: done`;
    case 'canceled': return `${what}: given up`;
    case 'failed': return `${what}: ${detail}`;
  }
}

function Table({ comparison, app }: { comparison: Comparison; app: App }) {
  const longest_s = Math.max(...comparison.runs.map(({ makespan_s }) => makespan_s ?? 0), 1e-9);
  if (comparison.runs.length === 0) return null;
  return (
    <div class="scrolling" tabIndex={0} role="region" aria-label="Policies compared">
      <table class="compared" data-test="compared">
        <thead><tr>
          <th scope="col">policy</th><th scope="col">succeeded</th><th scope="col">backlogged</th><th scope="col">makespan</th>
          <th scope="col">of sequential</th><th scope="col">mean wait</th><th scope="col">smallest clearance</th><th scope="col">change</th>
        </tr></thead>
        <tbody>{comparison.runs.map((run) => <Run key={run.policy} run={run} jobs={comparison.jobs} longest_s={longest_s} app={app} />)}</tbody>
      </table>
    </div>
  );
}

function Run({ run, jobs, longest_s, app }: { run: PolicyRun; jobs: number; longest_s: number; app: App }) {
  const { store, actions } = app;
  const mute = why_no_command(app) ?? why_no_change(store);
  const is_in_force = run.policy === store.policy;
  const ends = ends_in_words(run);
  return (
    <tr class={is_in_force ? 'in-force' : ''} data-test={`compared-${run.policy}`}>
      <th scope="row">{run.policy}</th>
      <td class="mono">{run.succeeded} of {jobs}{ends !== '' && <span class="dim"> ({ends})</span>}</td>
      <td class="mono">{run.backlogged}</td>
      <td class="mono">
        {run.makespan_s === null ? 'did not end' : seconds(run.makespan_s)}
        <span class="share" aria-hidden="true"><span style={{ width: `${(100 * (run.makespan_s ?? 0)) / longest_s}%` }} /></span>
      </td>
      <td class="mono">{share_in_words(run.makespan_ratio)}</td>
      <td class="mono">{seconds(run.wait_mean_s)}</td>
      <td class="mono">{run.min_clearance_m === null ? 'never near' : millimetres(run.min_clearance_m)}</td>
      <td>{is_in_force
        ? <span class="dim">in force</span>
        : <button class="small" data-test={`use-${run.policy}`} disabled={mute !== null} aria-label={`Change to ${run.policy}`}
          title={mute ?? ''} onClick={() => void actions.change_policy(run.policy)}>Use it</button>}</td>
    </tr>
  );
}
