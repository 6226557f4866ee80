import * as THREE from 'three';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { HeldObject, SceneObject } from '../src/server/messages';
import { forget_inks } from '../src/state/palette';
import { FinishedMesh } from '../src/view/finish';
import { SceneObjects } from '../src/view/scene_objects';
import { held_json, object_json } from './samples';

const kInks: Record<string, string> = { '--object': '#3d4653', '--blue': '#62bcf5', '--arm-0': '#56b6f2', '--arm-1': '#e59dbf' };

let links: Record<string, THREE.Group>;
let objects: SceneObjects;
let changes: number;
let load: (addresses: readonly string[]) => Promise<Map<string, THREE.BufferGeometry>>;

beforeEach(() => {
  vi.stubGlobal('document', { documentElement: null });
  vi.stubGlobal('getComputedStyle', () => ({ getPropertyValue: (name: string) => kInks[name] ?? '' }));
  forget_inks();
  changes = 0;
  load = () => Promise.resolve(new Map());
  links = { left: new THREE.Group(), right: new THREE.Group() };
  links['left']?.position.set(1, 2, 3);
  objects = new SceneObjects({ load: (addresses) => load(addresses) }, (arm, link) => (link === `${arm}_hand` ? links[arm] ?? null : null), (arm) => `var(--arm-${arm === 'left' ? 0 : 1})`, () => { changes += 1; });
});
afterEach(() => {
  vi.unstubAllGlobals();
  forget_inks();
});

const object = (name: string, over: object = {}) => object_json(name, over) as unknown as SceneObject;
const held = (name: string, arm: string, over: object = {}) => held_json(name, arm, over) as unknown as HeldObject;

function drawn(name: string): FinishedMesh {
  const found = objects.find(name);
  if (!(found instanceof FinishedMesh)) throw new Error(`${name} is not drawn`);
  return found;
}
const place = (name: string) => drawn(name).getWorldPosition(new THREE.Vector3()).toArray().map((m) => Number(m.toFixed(6)) + 0);  // + 0 makes 0 of -0
const color = (name: string) => `#${(drawn(name).fine.material as THREE.MeshStandardMaterial).color.getHexString()}`;

describe('Drawn objects', () => {
  it('move with the link that holds them, at their pose in its frame', () => {
    objects.show([object('table')], [held('part', 'left', { xyz: [0, 0, 0.1] })]);
    expect(drawn('part').parent).toBe(links['left']);
    expect(place('part')).toEqual([1, 2, 3.1]);
    links['left']?.position.set(0, 0, 1);
    links['left']?.rotateX(Math.PI);
    expect(place('part')).toEqual([0, 0, 0.9]);
    expect(place('table')).toEqual([0, 0, 0]);
  });

  it('have their arm\'s color while they are held, in each theme', () => {
    objects.show([object('table')], [held('part', 'left'), held('bolt', 'right')]);
    expect(['table', 'part', 'bolt'].map(color)).toEqual(['#3d4653', '#56b6f2', '#e59dbf']);
    kInks['--arm-0'] = '#0a5f9e';
    forget_inks();
    objects.repaint();
    expect(color('part')).toBe('#0a5f9e');
    kInks['--arm-0'] = '#56b6f2';
  });

  it('are in the scene again after they are detached, and nowhere else', () => {
    objects.show([object('table')], [held('part', 'left')]);
    objects.show([object('table'), object('part', { xyz: [0.5, 0, 0] })], []);
    expect(drawn('part').parent).toBe(objects.group);
    expect(place('part')).toEqual([0.5, 0, 0]);
    expect(color('part')).toBe('#3d4653');
    expect(links['left']?.children).toEqual([]);
    objects.show([object('table')], [held('part', 'right')]);
    expect(objects.group.children.map(({ name }) => name)).toEqual(['table']);
    expect(links['right']?.children.map(({ name }) => name)).toEqual(['part']);
  });

  it('have the same shapes as in the scene', async () => {
    const surface = new THREE.TetrahedronGeometry(0.1);
    load = () => Promise.resolve(new Map([['/part.stl', surface]]));
    const shapes = { box: { box: [0.1, 0.2, 0.3] }, can: { box: undefined, cylinder: [0.05, 0.2] }, ball: { box: undefined, sphere: [0.04] }, mesh: { box: undefined, mesh: '/part.stl', scale: [2, 2, 2] } };
    const size = (name: string) => {
      const { geometry } = drawn(name).fine;
      geometry.computeBoundingBox();
      return geometry.boundingBox?.getSize(new THREE.Vector3()).toArray().map((m) => Number(m.toFixed(3)));
    };
    const shown = async (scene: SceneObject[], in_hand: HeldObject[]) => {
      objects.show(scene, in_hand);
      await vi.waitFor(() => drawn('mesh'));
      return Object.keys(shapes).map(size);
    };
    const sizes = await shown(Object.entries(shapes).map(([name, shape]) => object(name, shape)), []);
    expect(sizes[0]).toEqual([0.1, 0.2, 0.3]);
    expect(await shown([], Object.entries(shapes).map(([name, shape]) => held(name, 'left', shape)))).toEqual(sizes);
  });

  it('are drawn when their robot is drawn, if that is later', () => {
    const { left } = links;
    delete links['left'];
    const [scene, in_hand] = [[object('table')], [held('part', 'left')]];
    objects.show(scene, in_hand);
    expect(objects.find('part')).toBeNull();
    links['left'] = left as THREE.Group;
    objects.show(scene, in_hand);  // not drawn again, because nothing changed
    expect(objects.find('part')).toBeNull();
    objects.renew();
    expect(drawn('part').parent).toBe(left);
    expect(changes).toBe(2);
  });

  it('are recognized by a click, and highlighted', () => {
    objects.show([object('table')], [held('part', 'left')]);
    expect(objects.name_of(drawn('part'))).toBe('part');
    expect(objects.name_of(drawn('part').children[0] as THREE.Object3D)).toBe('part');
    expect(objects.name_of(links['left'] as THREE.Object3D)).toBeNull();
    objects.light('part');
    expect((drawn('part').fine.material as THREE.MeshStandardMaterial).emissive.getHex()).not.toBe(0);
    expect((drawn('table').fine.material as THREE.MeshStandardMaterial).emissive.getHex()).toBe(0);
  });
});
