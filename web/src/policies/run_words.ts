// Describes the results of the simulation under one policy. Pure.

import type { PolicyRun } from '../server/messages';
import { kText } from '../strings';

/** Says how many jobs ended without success, and how. Empty if all jobs succeeded. */
export function ends_in_words(run: PolicyRun): string {
  const ends = (['expired', 'failed', 'canceled', 'refused', 'unfinished'] as const)
    .flatMap((end) => (run[end] > 0 ? [`${run[end]} ${end}`] : []));
  return [...ends, ...(run.given_up ? [kText.policies.aborted] : [])].join(', ');
}

export function share_in_words(share: number | null): string {
  return share === null ? kText.common.unknown_time : `${(100 * share).toFixed(0)} %`;
}
