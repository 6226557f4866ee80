// Makes names from users safe to show: a name cannot break a line or pass for another name. Pure.
// Invisible characters are shown as their code, right-to-left text is isolated, and stacked
// combining marks are cut. The results are strings, because canvases, titles and screen readers
// take only strings.

import { kText } from './strings';

// Control characters, direction marks, zero-width characters, and other characters that look blank.
const kUnseen = /[\u0000-\u001f\u007f-\u009f\u00ad\u034f\u061c\u115f\u1160\u17b4\u17b5\u180b-\u180f\u200b\u200c\u200e\u200f\u2028-\u202e\u2060-\u206f\u2800\u3164\ufeff\uffa0\ufff9-\ufffb\u{e0000}-\u{e007f}]|(?<!\p{Extended_Pictographic}|\ufe0f)\u200d/gu;
const kPiled = /(\p{M}{2})\p{M}+/gu;
// Right-to-left scripts such as Hebrew and Arabic.
const kFromRight = /[\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefe\u{10800}-\u{10fff}\u{1e800}-\u{1efff}]/u;
const kIsolate = '\u2068';
const kIsolated = '\u2069';

/**
 * Returns the name in a form that is safe to show. A name of blanks becomes "(blank)". An empty
 * name stays empty.
 */
export function shown_name(name: string): string {
  return name !== '' && name.trim() === '' ? kText.common.blank_name : shown_text(name);
}

/** Returns a text that may contain names, in a form that is safe to show. */
export function shown_text(text: string): string {
  const seen = text.replace(kUnseen, (unseen) => `⟨U+${(unseen.codePointAt(0) ?? 0).toString(16).toUpperCase().padStart(4, '0')}⟩`).replace(kPiled, '$1');
  return kFromRight.test(seen) ? kIsolate + seen + kIsolated : seen;
}

const kGraphemes = new Intl.Segmenter(undefined, { granularity: 'grapheme' });

/** Splits a short text into user-perceived characters. */
export function characters_of(text: string): string[] {
  return [...kGraphemes.segment(text)].map(({ segment }) => segment);
}

// Code units of the text that are read for each character to keep; only rare characters have more.
// Without this limit a text of 100 kB blocked the page for a minute, because segmenting takes
// quadratic time.
const kMostParts = 32;

/**
 * Returns at most `most` characters of the text. No character is split. A cut text ends in …, which
 * counts as one character.
 */
export function cut_text(text: string, most: number): string {
  if (text.length <= most) return text;
  const looked_at = text.slice(0, kMostParts * most);
  const characters: string[] = [];
  for (const { segment } of kGraphemes.segment(looked_at)) if (characters.push(segment) > most) break;
  if (looked_at === text && characters.length <= most) return text;
  // Drops the last segment too, because the limit on code units may have split it.
  return `${characters.slice(0, Math.min(most, characters.length) - 1).join('')}…`;
}

/**
 * Removes the prefix that all names share. The prefix ends with `_`: `left_panda_joint1` and
 * `left_panda_joint2` become `joint1` and `joint2`.
 */
export function short_names(names: readonly string[]): string[] {
  const [first = ''] = names;
  let shared = names.length < 2 ? 0 : first.length;
  while (shared > 0 && !(first[shared - 1] === '_' && names.every((name) => name.startsWith(first.slice(0, shared)) && name.length > shared))) shared -= 1;
  return names.map((name) => name.slice(shared));
}

/** Escapes invisible characters in JSON. The JSON keeps its meaning. */
export function shown_json(json: string): string {
  return json.replace(kUnseen, (unseen) => (unseen === '\n' ? unseen : [...Array(unseen.length).keys()].map((i) => `\\u${unseen.charCodeAt(i).toString(16).padStart(4, '0')}`).join('')));
}
