// Splits pasted text into one job or a batch of jobs. Pure. Does not validate the jobs; the server
// does.

import { shown_name } from '../names';
import { kText } from '../strings';

export type Batch =
  | { kind: 'one'; text: string }
  | { kind: 'batch'; jobs: unknown[] };

/**
 * Reads a batch from a list of jobs, a list of {"at", "job"} as in a jobs file, or {"jobs": […]}. A
 * bare trajectory is put into a job. Any other text is taken as one job.
 */
export function read_batch(text: string): Batch {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    return { kind: 'one', text };
  }
  if (is_trajectory(value)) return { kind: 'one', text: JSON.stringify({ trajectory: value }) };
  const list = Array.isArray(value) ? value : (value as { jobs?: unknown } | null)?.jobs;
  if (!Array.isArray(list) || list.length === 0) return { kind: 'one', text };
  return { kind: 'batch', jobs: list.map((entry) => (is_trajectory(entry) ? { trajectory: entry as unknown } : (entry as { job?: unknown } | null)?.job ?? entry)) };
}

/** Returns true for a bare JointTrajectory. */
function is_trajectory(value: unknown): boolean {
  const { joint_names, points } = (value ?? {}) as { joint_names?: unknown; points?: unknown };
  return Array.isArray(joint_names) && Array.isArray(points);
}

/** The body of one request, with a title that the page shows. */
export interface Body { title: string; body: Blob }

export function bodies_of(batch: Batch): Body[] {
  if (batch.kind === 'one') return [{ title: kText.compose.this_job, body: new Blob([batch.text]) }];
  return batch.jobs.map((job, i) => {
    const { id, name } = (job ?? {}) as { id?: unknown; name?: unknown };
    const title = [id, name].find((one): one is string => typeof one === 'string' && one !== '');
    return { title: title === undefined ? kText.compose.job_number(i + 1) : shown_name(title), body: new Blob([JSON.stringify(job)]) };
  });
}
