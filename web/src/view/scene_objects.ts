// The drawn objects: those of the scene, and those that arms hold. One may be highlighted. A held
// object is attached to the link that holds it, so that it moves with it, and has its arm's color.

import * as THREE from 'three';
import type { HeldObject, SceneObject } from '../server/messages';
import { ink } from '../state/palette';
import { FinishedMesh } from './finish';
import { dispose, object_mesh } from './shapes';
import type { SurfaceShelf, Surfaces } from './surfaces';

const kLit = 0.16;

/** Returns the drawn link of an arm, or null if it is not drawn (yet). */
export type FindLink = (arm: string, link: string) => THREE.Object3D | null;

interface Drawn { mesh: THREE.Object3D; arm: string | null }

export class SceneObjects {
  /** The objects of the scene. Held objects are below the robots. */
  readonly group = new THREE.Group();
  private drawn_: Drawn[] = [];
  private objects_: readonly SceneObject[] | null = null;
  private held_: readonly HeldObject[] = [];
  private lit_: string | null = null;

  /**
   * `color` returns the color of an arm. `changed` is called after each change. After show() it may
   * be called later, because meshes are loaded first.
   */
  constructor(private readonly shelf_: Pick<SurfaceShelf, 'load'>, private readonly find_link_: FindLink, private readonly color_: (arm: string) => string, private readonly changed_: () => void) {}

  show(objects: readonly SceneObject[], held: readonly HeldObject[]): void {
    if (objects === this.objects_ && held === this.held_) return;
    this.objects_ = objects;
    this.held_ = held;
    const addresses = [...objects, ...held.map(({ object }) => object)].flatMap(({ mesh }) => mesh ?? []);
    if (addresses.length === 0) return this.put(objects, held, new Map());
    void this.shelf_.load(addresses).then((surfaces) => {
      if (this.objects_ === objects && this.held_ === held) this.put(objects, held, surfaces);
    });
  }

  /**
   * Draws the objects again at their known poses. This undoes a drag. Must be called after other
   * robots are drawn.
   */
  renew(): void {
    const objects = this.objects_;
    this.objects_ = null;
    if (objects) this.show(objects, this.held_);
  }

  find(name: string | null): THREE.Object3D | null {
    return this.drawn_.find(({ mesh }) => mesh.name === name)?.mesh ?? null;
  }

  /** Highlights the object of this name, or no object if null. */
  light(name: string | null): void {
    this.lit_ = name;
    this.repaint();
  }

  /** Returns the name of a drawn object. */
  name_of(node: THREE.Object3D): string | null {
    return this.drawn_.find(({ mesh }) => mesh === node || mesh.children.includes(node))?.mesh.name ?? null;
  }

  private put(objects: readonly SceneObject[], held: readonly HeldObject[], surfaces: Surfaces): void {
    for (const { mesh } of this.drawn_) {
      dispose(mesh);
      mesh.removeFromParent();
    }
    this.drawn_ = [];
    for (const object of objects) this.add(object, this.group, null, surfaces);
    for (const { object, link, arm } of held) this.add(object, this.find_link_(arm, link), arm, surfaces);
    this.repaint();
  }

  private add(object: SceneObject, parent: THREE.Object3D | null, arm: string | null, surfaces: Surfaces): void {
    const surface = object.mesh === undefined ? null : surfaces.get(object.mesh);
    const mesh = parent && object_mesh(object, surface ?? null);
    if (!mesh) return;
    parent.add(mesh);
    this.drawn_.push({ mesh, arm });
  }

  /** Applies the theme's colors. */
  repaint(): void {
    const light = new THREE.Color(ink('--blue'));
    for (const { mesh, arm } of this.drawn_) {
      const material = mesh instanceof FinishedMesh ? mesh.fine.material : null;
      if (!(material instanceof THREE.MeshStandardMaterial)) continue;
      material.color.set(ink(arm === null ? '--object' : this.color_(arm)));
      material.emissive.copy(light).multiplyScalar(mesh.name === this.lit_ ? kLit : 0);
    }
    this.changed_();
  }
}
