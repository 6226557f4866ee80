import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import { closest_points, corners_of, type Surface } from '../src/view/closest';

function surface(geometry: THREE.BufferGeometry, x: number, y: number, z: number): Surface {
  return { corners: corners_of(geometry), X_W: new THREE.Matrix4().makeTranslation(x, y, z) };
}
const apart = (a: Surface, b: Surface) => {
  const points = closest_points(a, b);
  return points ? points[0].distanceTo(points[1]) : null;
};

describe('Closest points of two surfaces', () => {
  it('are as far apart as the shapes', () => {
    const box = new THREE.BoxGeometry(1, 1, 1);
    expect(apart(surface(box, 0, 0, 0), surface(box, 3, 0.2, 0))).toBeCloseTo(2, 4);
    expect(apart(surface(box, 0, 0, 0), surface(box, 3, 3, 0))).toBeCloseTo(2 * Math.SQRT2, 4);
    const ball = new THREE.SphereGeometry(0.5, 32, 16);
    expect(apart(surface(ball, 0, 0, 2), surface(box, 0.1, 0, 0))).toBeCloseTo(1, 2);
    const table = new THREE.BoxGeometry(2, 2, 0.1);
    expect(apart(surface(ball, 0.4, 0.3, 1), surface(table, 0, 0, 0))).toBeCloseTo(0.45, 2);
  });

  it('are at most as far apart as the corners, for random spheres and boxes', () => {
    let seed = 1;
    const random = () => { seed = (seed * 16807) % 2147483647; return seed / 2147483647; };
    for (let i = 0; i < 40; i++) {
      const a = surface(new THREE.BoxGeometry(0.2 + random(), 0.2 + random(), 0.2 + random()), 0, 0, 0);
      const b = surface(new THREE.SphereGeometry(0.2, 12, 8), 2 + random(), random() - 0.5, random() - 0.5);
      let least = Infinity;
      const [p, q] = [new THREE.Vector3(), new THREE.Vector3()];
      for (let k = 0; k < a.corners.length; k += 3) {
        p.fromArray(a.corners, k).applyMatrix4(a.X_W);
        for (let l = 0; l < b.corners.length; l += 3) least = Math.min(least, p.distanceTo(q.fromArray(b.corners, l).applyMatrix4(b.X_W)));
      }
      expect(apart(a, b)).toBeLessThanOrEqual(least + 1e-6);
    }
  });

  it('are null for empty surfaces', () => {
    expect(apart(surface(new THREE.BufferGeometry().setFromPoints([]), 0, 0, 0), surface(new THREE.BoxGeometry(), 0, 0, 0))).toBeNull();
  });
});
