import * as THREE from 'three';
import { describe, expect, it, vi } from 'vitest';
import type { URDFLink } from 'urdf-loader';
import { choose_shapes } from '../src/view/robot';
import { object_mesh } from '../src/view/shapes';
import { parse_surface, SurfaceShelf } from '../src/view/surfaces';

const kObj = 'mtllib /etc/passwd\nv 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 3\nf 1 2 3 4\n';

function bytes(text: string): ArrayBuffer {
  return new TextEncoder().encode(text).buffer as ArrayBuffer;
}

/** Returns a binary STL file of one triangle. */
function stl(): ArrayBuffer {
  const view = new DataView(new ArrayBuffer(84 + 50));
  view.setUint32(80, 1, true);
  [0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2, 0].forEach((number, i) => view.setFloat32(84 + 4 * i, number, true));
  return view.buffer;
}

function size(geometry: THREE.BufferGeometry): number[] {
  return new THREE.Box3().setFromBufferAttribute(geometry.getAttribute('position') as THREE.BufferAttribute)
    .getSize(new THREE.Vector3()).toArray();
}

describe('Surface', () => {
  it('is read from STL and OBJ as triangles with normals', () => {
    const triangle = parse_surface('/m/a.STL', stl());
    expect(triangle.getAttribute('position').count).toBe(3);
    expect(size(triangle)).toEqual([1, 2, 0]);
    const square = parse_surface('/m/a.obj', bytes(kObj));
    expect(square.getAttribute('position').count).toBe(6);
    expect(square.hasAttribute('normal')).toBe(true);
    expect(size(square)).toEqual([1, 2, 3]);
  });

  it('is refused if empty or of another kind', () => {
    expect(() => parse_surface('/m/a.obj', bytes('v 0 0 0\n'))).toThrow();
    expect(() => parse_surface('/m/a.ply', bytes('ply'))).toThrow(/neither STL nor OBJ nor COLLADA/);
  });

  it('is fetched once, and again after a failure', async () => {
    const warn = vi.spyOn(console, 'warn').mockImplementation(() => {});
    const asked: string[] = [];
    const shelf = new SurfaceShelf((address) => {
      asked.push(address);
      return address.includes('gone') ? Promise.reject(new Error('404')) : Promise.resolve(bytes(kObj));
    });
    const first = await shelf.load(['/api/a.obj', '/api/a.obj', '/api/gone.obj']);
    expect(first.get('/api/a.obj')).toBeInstanceOf(THREE.BufferGeometry);
    expect(first.get('/api/gone.obj')).toBeNull();
    const again = await shelf.load(['/api/a.obj', '/api/gone.obj']);
    expect(again.get('/api/a.obj')).toBe(first.get('/api/a.obj'));
    expect(asked).toEqual(['/api/a.obj', '/api/gone.obj', '/api/gone.obj']);
    expect(warn).toHaveBeenCalledTimes(2);
    warn.mockRestore();
  });

  it('is never fetched from another server', async () => {
    const warn = vi.spyOn(console, 'warn').mockImplementation(() => {});
    const fetched = vi.spyOn(globalThis, 'fetch');
    expect((await new SurfaceShelf().load(['https://example.org/a.stl'])).get('https://example.org/a.stl')).toBeNull();
    expect((await new SurfaceShelf().load(['//example.org/api/a.stl'])).get('//example.org/api/a.stl')).toBeNull();
    expect(fetched).not.toHaveBeenCalled();
    fetched.mockRestore();
    warn.mockRestore();
  });
});

describe('Object with a mesh', () => {
  const object = {
    name: 'part', xyz: [1, 0, 0] as [number, number, number], rpy: [0, 0, 0] as [number, number, number],
    mesh: '/api/a.obj', scale: [2, 1, -1] as [number, number, number],
  };

  it('is drawn scaled, and faces outward when mirrored', () => {
    const surface = parse_surface('/m/a.stl', stl());
    const mesh = object_mesh(object, surface) as THREE.Mesh;
    expect(size(mesh.geometry)).toEqual([2, 2, 0]);
    const p = mesh.geometry.getAttribute('position');
    const at = (i: number) => new THREE.Vector3().fromBufferAttribute(p as THREE.BufferAttribute, i);
    const normal = at(1).sub(at(0)).cross(at(2).sub(at(0)));
    expect(normal.z).toBeLessThan(0);  // the normal pointed up before the mirroring along z
    expect(size(surface)).toEqual([1, 2, 0]);  // the cached surface is unchanged
  });

  it('is drawn as a marker if its mesh cannot be read', () => {
    const mark = object_mesh(object, null) as THREE.Mesh;
    expect(mark.position.x).toBe(1);
    expect(size(mark.geometry).every((length) => length > 0 && length < 0.2)).toBe(true);
  });
});

describe('Link', () => {
  const yellow = new THREE.MeshPhongMaterial({ color: 0xffcc00 });

  /** Returns a link with visuals and collision shapes. Each flag says whether the mesh was read. */
  function link(visuals: boolean[], colliders: boolean[]): URDFLink {
    const made = new THREE.Group();
    const add = (kind: string, read: boolean) => {
      const node = new THREE.Group();
      Object.assign(node, { [kind]: true });
      const mesh = new THREE.Mesh(new THREE.BoxGeometry(), kind === 'isURDFVisual' ? yellow : undefined);
      mesh.userData['missing'] = !read;
      made.add(node.add(mesh));
    };
    visuals.forEach((read) => add('isURDFVisual', read));
    colliders.forEach((read) => add('isURDFCollider', read));
    return made as unknown as URDFLink;
  }
  function drawn(...links: URDFLink[]): THREE.Mesh[][] {
    choose_shapes({ links: Object.fromEntries(links.map((l, i) => [String(i), l])) });
    return links.map((l) => {
      const found: THREE.Mesh[] = [];
      l.traverse((node) => { if (node instanceof THREE.Mesh) found.push(node); });
      return found;
    });
  }

  it('is drawn by its visuals if they were read', () => {
    const [meshes] = drawn(link([true, false], [true]));
    expect(meshes).toHaveLength(1);
    expect(meshes?.[0]?.material).toBe(yellow);
  });

  it('is drawn by its collision shapes in the color of missing visuals', () => {
    const [missing, read] = drawn(link([false], [true, true]), link([true], [true]));
    expect(missing?.map((mesh) => mesh.material)).toEqual([yellow, yellow]);
    expect(read).toHaveLength(1);
  });

  it('is drawn by its collision shapes if the robot has no visuals, else not at all', () => {
    expect(drawn(link([], [true]))[0]).toHaveLength(1);
    expect(drawn(link([], [true]), link([true], []))[0]).toHaveLength(0);
  });

  it('is drawn as a marker if no shape was read, and not at all if it has no shape', () => {
    const [lost, bare] = drawn(link([false], [false]), link([], []));
    expect(lost?.map((mesh) => mesh.geometry.type)).toEqual(['OctahedronGeometry']);
    expect(bare).toHaveLength(0);
  });
});
