// Reads jobs from a file. A file above the server's limit is not read. A file without a job is
// refused at once, with its name.

import { shown_name } from '../names';
import { bytes_in_words } from '../wording';
import { kText } from '../strings';
import { composed, type Composed } from './composed';
import { composed_in_worker, kLong } from './long_text';

/** The server's limit for a request body (kBodyMax in server/http/session.h; answered with 413). */
export const kBodyMax_bytes = 8 * 1024 * 1024;

export type JobFile = { ok: true; text: string } | { ok: false; fault: string };

/** Returns why a text of this length cannot be sent, or null if it can. */
export function too_large(what: string, bytes: number): string | null {
  return bytes <= kBodyMax_bytes ? null : kText.compose.too_large(what, bytes_in_words(bytes), bytes_in_words(kBodyMax_bytes));
}

export async function read_job_file(file: Pick<File, 'name' | 'size' | 'text'>, in_worker: (text: string) => Promise<Composed> = (text) => composed_in_worker(text, new AbortController().signal)): Promise<JobFile> {
  const name = shown_name(file.name);
  const large = too_large(name, file.size);
  if (large !== null) return { ok: false, fault: large };
  try {
    const text = await file.text();
    const { fault } = text.length > kLong ? await in_worker(text) : composed(text);
    return fault === null ? { ok: true, text } : { ok: false, fault: `${name} ${fault}.` };
  } catch (error) {
    return { ok: false, fault: kText.compose.unreadable(name, String(error)) };
  }
}
