// The drawn scene objects; one may be highlighted.

import * as THREE from 'three';
import type { SceneObject } from '../server/messages';
import { ink } from '../state/palette';
import { FinishedMesh } from './finish';
import { dispose, object_mesh } from './shapes';
import type { SurfaceShelf, Surfaces } from './surfaces';

const kLit = 0.16;

export class SceneObjects {
  readonly group = new THREE.Group();
  private shown_: readonly SceneObject[] | null = null;
  private lit_: string | null = null;

  /**
   * `drawn` is called after each change. After show() it may be called later, because meshes are
   * loaded first.
   */
  constructor(private readonly shelf_: SurfaceShelf, private readonly drawn_: () => void) {}

  show(objects: readonly SceneObject[]): void {
    if (objects === this.shown_) return;
    this.shown_ = objects;
    const addresses = objects.flatMap(({ mesh }) => mesh ?? []);
    if (addresses.length === 0) return this.put(objects, new Map());
    void this.shelf_.load(addresses).then((surfaces) => {
      if (this.shown_ === objects) this.put(objects, surfaces);
    });
  }

  /** Draws the objects again at their known poses. This undoes a drag. */
  renew(): void {
    const shown = this.shown_;
    this.shown_ = null;
    if (shown) this.show(shown);
  }

  find(name: string | null): THREE.Object3D | null {
    return this.group.children.find((child) => child.name === name) ?? null;
  }

  /** Highlights the object of this name, or no object if null. */
  light(name: string | null): void {
    this.lit_ = name;
    this.repaint();
  }

  /** Returns the name of a drawn object. */
  name_of(node: THREE.Object3D): string | null {
    const object = this.group.children.find((child) => child === node || child.children.includes(node));
    return object?.name ?? null;
  }

  private put(objects: readonly SceneObject[], surfaces: Surfaces): void {
    dispose(this.group);
    this.group.clear();
    for (const object of objects) {
      const surface = object.mesh === undefined ? null : surfaces.get(object.mesh);
      const mesh = object_mesh(object, surface ?? null);
      if (mesh) this.group.add(mesh);
    }
    this.repaint();
  }

  /** Applies the theme's colors. */
  repaint(): void {
    const [ground, light] = [new THREE.Color(ink('--object')), new THREE.Color(ink('--blue'))];
    for (const object of this.group.children) {
      const material = object instanceof FinishedMesh ? object.fine.material : null;
      if (!(material instanceof THREE.MeshStandardMaterial)) continue;
      material.color.copy(ground);
      material.emissive.copy(light).multiplyScalar(object.name === this.lit_ ? kLit : 0);
    }
    this.drawn_();
  }
}
