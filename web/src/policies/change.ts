// Whether another policy can be put in force: the server refuses it while a job is admitted. Pure.

import type { Store } from '../state/store';
import { kText } from '../strings';

export function why_no_change(store: Pick<Store, 'jobs'>): string | null {
  const admitted = store.jobs('running').length + store.jobs('scheduled').length;
  return admitted === 0 ? null : kText.policies.admitted(admitted);
}
