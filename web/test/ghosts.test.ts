import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import type { Cell } from '../src/server/messages';
import { Ghosts } from '../src/view/ghosts';

const kArms = ['a', 'b', 'c'];
const cell = { robots: kArms.map((name) => ({ name, arms: [{ name, joints: [`${name}1`] }] })) } as unknown as Cell;

describe('Ghosts', () => {
  const built: string[] = [];
  const ghosts = new Ghosts(0.5, ({ name }) => {
    built.push(name);
    return { root: new THREE.Group(), set_q: () => true };
  });
  const show = (q: Record<string, number> | null) => ghosts.show({ q, now: {} }, cell, new Map(), () => '#fff');
  const visible = () => ghosts.group.children.filter((child) => child.visible).length;

  it('are built one at a time, and only when needed', () => {
    const of_two = { a1: 0, c1: 0 };
    expect([show(of_two), built]).toEqual([false, ['a']]);
    expect([show(of_two), built]).toEqual([true, ['a', 'c']]);
    expect(visible()).toBe(2);
  });
  it('are visible only with a pose', () => {
    expect([show({ c1: 1 }), visible()]).toEqual([true, 1]);
    expect([show(null), visible()]).toEqual([true, 0]);
    expect(built).toEqual(['a', 'c']);
  });
});
