// The verdicts of POST /check: each says what would happen if its job were submitted now.

import type { Api } from '../server/api';
import type { Problem, Verdict } from '../server/messages';
import { conflict_in_words, millimeters, seconds, wait_in_words } from '../wording';
import type { Body } from './batch';
import { kText } from '../strings';
import { Refused } from './refused';

const kSays = kText.compose;

export type CheckResult = { title: string } & ({ ok: true; verdict: Verdict } | { ok: false; problem: Problem });

const kMost = 50;

/**
 * Checks the jobs one after the other, because each check costs the server some work. Jobs after
 * the first `kMost` are not checked.
 */
export async function check_all(bodies: readonly Body[], api: Pick<Api, 'check'>): Promise<CheckResult[]> {
  const results: CheckResult[] = [];
  for (const { title, body } of bodies.slice(0, kMost)) {
    const answer = await api.check(body);
    results.push(answer.ok ? { title, ok: true, verdict: answer.value } : { title, ok: false, problem: answer.problem });
  }
  return results;
}

/** `show` previews the motion at a time, in seconds from the start of the motion. */
export function CheckResults({ results, show }: { results: CheckResult[]; show: ((t_s: number) => void) | null }) {
  return (
    <ul class="check-results" role="status" data-test="check-results">
      {results.map((result, i) => (
        <li key={i}>
          {result.ok ? <Result title={result.title} verdict={result.verdict} show={show} /> : <><b>{result.title}</b><Refused problem={result.problem} /></>}
        </li>
      ))}
    </ul>
  );
}

const kWords: Record<Verdict['verdict'], string> = {
  free: kSays.free, conflict: kSays.conflict, undecided: kSays.undecided,
};

/** Returns true if the job only waits for earlier jobs of its arm. */
export function only_in_turn({ verdict, waits_on }: Pick<Verdict, 'verdict' | 'waits_on'>): boolean {
  return verdict === 'conflict' && waits_on.length > 0 && waits_on.every(({ kind }) => kind === 'predecessor');
}

function Result({ title, verdict, show }: { title: string; verdict: Verdict; show: ((t_s: number) => void) | null }) {
  const { earliest_start_s: start_s, clearance_bound_m: bound_m, self_clearance_bound_m: self_m } = verdict;
  const in_turn = only_in_turn(verdict);
  const in_words = verdict.verdict === 'free' || in_turn ? wait_in_words : conflict_in_words;
  const could = verdict.verdict === 'free' ? kSays.would : kSays.could;
  const when = start_s === null ? (in_turn ? kSays.start_at_turn : kSays.no_start) : start_s > 0 ? kSays.start_in(could, seconds(start_s)) : kSays.start_now(could);
  return (
    <>
      <div class={`verdict-word ${in_turn ? 'in-turn' : verdict.verdict}`}><b>{title}</b>: {in_turn ? kSays.in_turn : kWords[verdict.verdict]}</div>
      <div>{when}</div>
      {bound_m !== null && <div class="dim small">{kSays.clearance(millimeters(bound_m))}{self_m !== null && kSays.self_clearance(millimeters(self_m))}.</div>}
      {verdict.waits_on.map((conflict, i) => (
        <div key={i} class="words">
          {in_words(conflict)}
          {show && conflict.own_time_s !== null && (
            <>{' '}<button class="small" data-test="show-conflict" onClick={() => show(conflict.own_time_s ?? 0)}>{kSays.show_conflict}</button></>
          )}
        </div>
      ))}
    </>
  );
}
