// A job as a command line or a program would ask for it. Pure. What users named is quoted, never
// pasted raw: a command that is copied must not do more than it says.

import type { Job } from '../server/messages';

export function curl_of(job: Pick<Job, 'id'>, origin: string): string {
  return `curl -s ${quoted_for_shell(address_of(job, origin))}`;
}

export function python_of(job: Pick<Job, 'id'>, origin: string): string {
  return [
    'import json',
    'import urllib.request',
    '',
    `with urllib.request.urlopen(${JSON.stringify(address_of(job, origin))}) as answer:`,
    '    job = json.load(answer)',
    'print(job["state"], job["waits_on"])',
  ].join('\n');
}

function address_of(job: Pick<Job, 'id'>, origin: string): string {
  return `${origin}/api/v1/jobs/${encodeURIComponent(job.id)}`;
}

/** Single quotes keep everything but themselves. */
export function quoted_for_shell(text: string): string {
  return `'${text.replaceAll("'", "'\\''")}'`;
}
