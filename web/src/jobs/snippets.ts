// A job, or its submission, as a curl command or a Python program. Pure. Texts from users are
// always quoted, so that a copied command does nothing else. Tokens are read from the environment;
// a snippet never contains one.

import { kApi } from '../server/api';
import type { Job } from '../server/messages';

/** `origin` is the server's address. `with_token` is true if the server requires a token. */
export interface Asked { origin: string; with_token: boolean }

const kVariable = 'ARMLOOM_TOKEN';

export function curl_of(job: Pick<Job, 'id'>, asked: Asked): string {
  return `curl -s ${curl_token(asked)}${quoted_for_shell(address_of(job, asked))}`;
}

export function python_of(job: Pick<Job, 'id'>, asked: Asked): string {
  return [
    ...imports(asked),
    `request = urllib.request.Request(${JSON.stringify(address_of(job, asked))}${asked.with_token ? `, headers={${python_token()}}` : ''})`,
    'with urllib.request.urlopen(request) as answer:',
    '    job = json.load(answer)',
    'print(job["state"], job["waits_on"])',
  ].join('\n');
}

/**
 * Returns a command that submits the body. The body is passed on stdin, because a long body does
 * not fit into an argument.
 */
export function curl_to_post(path: string, body: string, asked: Asked): string {
  let end = 'END';
  while (body.includes(end)) end += '_';
  const address = quoted_for_shell(`${asked.origin}${kApi}${path}`);
  return `curl -s ${curl_token(asked)}${address} -H 'Content-Type: application/json' --data-binary @- <<'${end}'\n${body}\n${end}`;
}

export function python_to_post(path: string, body: string, asked: Asked): string {
  return [
    ...imports(asked),
    `body = ${python_text(body)}`,
    `headers = {"Content-Type": "application/json"${asked.with_token ? `, ${python_token()}` : ''}}`,
    `request = urllib.request.Request(${JSON.stringify(`${asked.origin}${kApi}${path}`)}, body.encode(), headers)`,
    'with urllib.request.urlopen(request) as answer:',
    '    print(json.load(answer))',
  ].join('\n');
}

function address_of(job: Pick<Job, 'id'>, { origin }: Asked): string {
  return `${origin}${kApi}/jobs/${encodeURIComponent(job.id)}`;
}

function curl_token({ with_token }: Asked): string {
  return with_token ? `-H "Authorization: Bearer $${kVariable}" ` : '';
}

function python_token(): string {
  return `"Authorization": "Bearer " + os.environ["${kVariable}"]`;
}

function imports({ with_token }: Asked): string[] {
  return ['import json', ...with_token ? ['import os'] : [], 'import urllib.request', ''];
}

/** Returns the text as a Python literal. Line breaks stay line breaks. */
function python_text(text: string): string {
  return `'''${text.replaceAll('\\', '\\\\').replaceAll("'", "\\'")}'''`;
}

/**
 * Quotes a text for the shell in single quotes, which protect all characters except single quotes.
 */
export function quoted_for_shell(text: string): string {
  return `'${text.replaceAll("'", "'\\''")}'`;
}
