// A warning that a job waits while later jobs go first.

import type { Job } from '../server/messages';
import { starvation_in_words } from '../wording';

export function Starves({ job }: { job: Job }) {
  const warning = starvation_in_words(job);
  return warning && <span class="starves" data-test="starves" title={warning.title}>! {warning.text}</span>;
}
