import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import type { Cell } from '../src/server/messages';
import { box_around_bases, distance_for, type Opening } from '../src/view/framing';

const v = (x: number, y: number, z: number) => new THREE.Vector3(x, y, z);
const corners_of = ({ min, max }: THREE.Box3) => [0, 1, 2, 3, 4, 5, 6, 7].map((i) => v(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z));

/**
 * Returns how far out the outermost corner of the box is seen at a camera distance. 1 is the border
 * of the opening.
 */
function outermost(box: THREE.Box3, direction: THREE.Vector3, opening: Opening, distance: number): number {
  const camera = new THREE.PerspectiveCamera();
  camera.up.set(0, 0, 1);
  const middle = box.getCenter(v(0, 0, 0));
  camera.position.copy(middle).addScaledVector(direction, distance);
  camera.lookAt(middle);
  camera.updateMatrixWorld();
  return Math.max(...corners_of(box).map((corner) => {
    const { x, y, z } = corner.applyMatrix4(camera.matrixWorldInverse);
    return Math.max(Math.abs(x / z) / opening.across, Math.abs(y / z) / opening.up);
  }));
}

describe('Distance to see a box completely', () => {
  const directions = [v(0.16, -1, 0.4), v(1, 0, 0.1), v(-0.5, 0.5, 2)].map((direction) => direction.normalize());
  const boxes = [new THREE.Box3(v(-1, -1, 0), v(1, 1, 1)), new THREE.Box3(v(2, -0.2, 0.1), v(9, 0.2, 0.3)), new THREE.Box3(v(0, 0, 0), v(0.1, 0.1, 5))];
  const openings: Opening[] = [{ across: 0.4, up: 0.23 }, { across: 0.1, up: 0.23 }];

  it('is the least: a corner touches the border and none is outside', () => {
    for (const box of boxes) {
      for (const direction of directions) {
        for (const opening of openings) expect(outermost(box, direction, opening, distance_for(box, direction, opening))).toBeCloseTo(1, 9);
      }
    }
  });
});

describe('Box around the bases', () => {
  const cell_of = (...bases: number[][]) => ({ robots: bases.map((xyz) => ({ base: { xyz, rpy: [0, 0, 0] } })) }) as unknown as Cell;

  it('contains every base with the working space of the arms', () => {
    const box = box_around_bases(cell_of([-0.5, 0, 0.1], [0.5, 0.2, 0.1]));
    expect(box?.containsPoint(v(-0.9, 0, 0.1))).toBe(true);
    expect(box?.containsPoint(v(0.5, 0.6, 0.9))).toBe(true);
    expect(box?.containsPoint(v(0, 0, 0))).toBe(false);
  });
  it('is null without robots', () => {
    expect(box_around_bases(cell_of())).toBeNull();
  });
});
