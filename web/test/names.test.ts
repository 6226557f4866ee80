import { describe, expect, it } from 'vitest';
import { cut_text, short_names, shown_json, shown_name, shown_text } from '../src/names';

describe('Names with a common prefix', () => {
  it('are distinguished by the rest', () => {
    expect(short_names(['left_panda_joint1', 'left_panda_joint2', 'left_panda_joint12'])).toEqual(['joint1', 'joint2', 'joint12']);
    expect(short_names(['ur_shoulder_pan_joint', 'ur_shoulder_lift_joint', 'ur_elbow_joint'])).toEqual(['shoulder_pan_joint', 'shoulder_lift_joint', 'elbow_joint']);
    expect(short_names(['left_joint1', 'right_joint1'])).toEqual(['left_joint1', 'right_joint1']);
    expect(short_names(['a_', 'a_b'])).toEqual(['a_', 'a_b']);
    expect(short_names(['left_joint1'])).toEqual(['left_joint1']);
    expect(short_names([])).toEqual([]);
  });
});

describe('Names from users', () => {
  it('are shown unchanged', () => {
    for (const name of ['', 'pick 7', '<b>&amp;', 'Größe Ω', '拾う', '👩‍🔬 lab', 'a‐b', 'e\u0301']) expect(shown_name(name)).toBe(name);
  });

  it('are shown as blank if nothing is visible', () => {
    for (const name of [' ', '   ', '\u00a0\u2003']) expect(shown_name(name)).toBe('(blank)');
    for (const name of ['\u200b', '\u3164', '\u2800', '\u2060\u200d']) expect(shown_name(name)).toMatch(/^(⟨U\+[0-9A-F]{4}⟩)+$/);
  });

  it('cannot change the direction of other text, nor pass for another name', () => {
    expect(shown_name('\u202epots lla')).toBe('⟨U+202E⟩pots lla');
    expect(shown_name('pi\u200dck')).not.toBe('pick');
    expect(shown_name('left\u2066\u2069')).toBe('left⟨U+2066⟩⟨U+2069⟩');
    // A right-to-left name is isolated.
    expect(shown_name('שלום')).toBe('\u2068שלום\u2069');
  });

  it('cannot grow out of their line', () => {
    expect(shown_name('a\nb')).toBe('a⟨U+000A⟩b');
    expect(shown_name(`Z${'\u0301'.repeat(40)}`)).toBe('Z\u0301\u0301');
  });

  it('keep their meaning in escaped JSON', () => {
    const job = { name: '\u202epots\u200b 👩‍🔬', note: 'a\nb' };
    const shown = shown_json(JSON.stringify(job, null, 2));
    expect(shown).not.toMatch(/[\u202e\u200b]/);
    expect(JSON.parse(shown)).toEqual(job);
  });

  it('are cut between characters', () => {
    const lab = '👩‍🔬';
    expect(cut_text(lab.repeat(4), 4)).toBe(lab.repeat(4));
    expect(cut_text(lab.repeat(5), 4)).toBe(`${lab.repeat(3)}…`);
    expect(cut_text('e\u0301'.repeat(9), 3)).toBe('e\u0301e\u0301…');
    expect(cut_text('pick 7', 6)).toBe('pick 7');
    expect(cut_text('pick 77', 6)).toBe('pick …');
  });

  it('are cut quickly at any length', () => {
    expect(cut_text('x'.repeat(1_000_000), 4)).toBe('xxx…');
    expect(cut_text(`a${'\u0301'.repeat(1_000_000)}`, 4)).toBe('…');  // one endless character, of which no part is complete
    expect(cut_text(`ab${'\u0301'.repeat(1_000_000)}`, 4)).toBe('a…');
  });

  it('are treated the same within server texts', () => {
    expect(shown_text('\u202e acknowledged: stopped')).toBe('⟨U+202E⟩ acknowledged: stopped');
  });
});
