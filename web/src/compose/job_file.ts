// A file that jobs are to be read from. What the server would not take is not read at all, and what is no job is
// said at once, with the file's name.

import { shown_name } from '../names';
import { bytes_in_words } from '../wording';
import { kText } from '../strings';
import { composed, type Composed } from './composed';
import { composed_in_worker, kLong } from './long_text';

/** A request to the server has at most so much (kBodyMax of server/http/session.h; 413 of the contract). */
export const kBodyMax_bytes = 8 * 1024 * 1024;

export type JobFile = { ok: true; text: string } | { ok: false; fault: string };

/** Why a text of so many bytes is not sent; null: it may be. */
export function too_large(what: string, bytes: number): string | null {
  return bytes <= kBodyMax_bytes ? null : kText.compose.too_large(what, bytes_in_words(bytes), bytes_in_words(kBodyMax_bytes));
}

export async function read_job_file(file: Pick<File, 'name' | 'size' | 'text'>, beside: (text: string) => Promise<Composed> = (text) => composed_in_worker(text, new AbortController().signal)): Promise<JobFile> {
  const name = shown_name(file.name);
  const large = too_large(name, file.size);
  if (large !== null) return { ok: false, fault: large };
  try {
    const text = await file.text();
    const { fault } = text.length > kLong ? await beside(text) : composed(text);
    return fault === null ? { ok: true, text } : { ok: false, fault: `${name} ${fault}.` };
  } catch (error) {
    return { ok: false, fault: kText.compose.unreadable(name, String(error)) };
  }
}
