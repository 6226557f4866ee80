// Names from users, as they are shown: whatever stands in them, they can neither break a line nor pass for
// something else. Pure. What cannot be seen is told by its code; what runs from right to left stays within
// its own place; of marks that are piled up some are left. Strings, as canvases, titles and voices want them.

import { kText } from './strings';

// Controls, what turns the direction of writing, what takes no room, and what looks like blank but is not.
const kUnseen = /[\u0000-\u001f\u007f-\u009f\u00ad\u034f\u061c\u115f\u1160\u17b4\u17b5\u180b-\u180f\u200b\u200c\u200e\u200f\u2028-\u202e\u2060-\u206f\u2800\u3164\ufeff\uffa0\ufff9-\ufffb\u{e0000}-\u{e007f}]|(?<!\p{Extended_Pictographic}|\ufe0f)\u200d/gu;
const kPiled = /(\p{M}{2})\p{M}+/gu;
// Hebrew, Arabic and the like.
const kFromRight = /[\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefe\u{10800}-\u{10fff}\u{1e800}-\u{1efff}]/u;
const kIsolate = '\u2068';
const kIsolated = '\u2069';

/** A name; one of blanks alone is told as such, an empty one stays empty. */
export function shown_name(name: string): string {
  return name !== '' && name.trim() === '' ? kText.common.blank_name : shown_text(name);
}

/** A text that names may stand in. */
export function shown_text(text: string): string {
  const seen = text.replace(kUnseen, (unseen) => `⟨U+${(unseen.codePointAt(0) ?? 0).toString(16).toUpperCase().padStart(4, '0')}⟩`).replace(kPiled, '$1');
  return kFromRight.test(seen) ? kIsolate + seen + kIsolated : seen;
}

const kGraphemes = new Intl.Segmenter(undefined, { granularity: 'grapheme' });

/** As people count them: what is drawn as one is one. For short texts. */
export function characters_of(text: string): string[] {
  return [...kGraphemes.segment(text)].map(({ segment }) => segment);
}

// What a browser counts characters in takes time with the square of its length: a page of 100 kB held this one up for
// a minute. Hardly any character has more parts.
const kMostParts = 32;

/** At most so many characters, none of them cut in two. What was cut ends in …, within these. */
export function cut_text(text: string, most: number): string {
  if (text.length <= most) return text;
  const looked_at = text.slice(0, kMostParts * most);
  const characters: string[] = [];
  for (const { segment } of kGraphemes.segment(looked_at)) if (characters.push(segment) > most) break;
  if (looked_at === text && characters.length <= most) return text;
  // The last one that was looked at may have been cut in two.
  return `${characters.slice(0, Math.min(most, characters.length) - 1).join('')}…`;
}

/** Without what all of them begin with, up to a `_`: of `left_panda_joint1` and `left_panda_joint2` `joint1` and `joint2`. */
export function short_names(names: readonly string[]): string[] {
  const [first = ''] = names;
  let shared = names.length < 2 ? 0 : first.length;
  while (shared > 0 && !(first[shared - 1] === '_' && names.every((name) => name.startsWith(first.slice(0, shared)) && name.length > shared))) shared -= 1;
  return names.map((name) => name.slice(shared));
}

/** JSON that means the same, and has nothing in it that is not seen. */
export function shown_json(json: string): string {
  return json.replace(kUnseen, (unseen) => (unseen === '\n' ? unseen : [...Array(unseen.length).keys()].map((i) => `\\u${unseen.charCodeAt(i).toString(16).padStart(4, '0')}`).join('')));
}
