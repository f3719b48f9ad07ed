/** The visuals of a robot file as three.js meshes, one group a body. */

import {
  BoxGeometry, BufferGeometry, CapsuleGeometry, CylinderGeometry, Float32BufferAttribute, Group, Mesh, MeshLambertMaterial, SphereGeometry,
} from "three";
import type { Shape, Triangles } from "../api/types";
import { matrix } from "./frames";

/** Shapes that move together; `body` is what a pointer finds in them. `bring` is asked for the triangles of a mesh. */
export function shapeGroup(shapes: readonly Shape[], body: number | null, bring: (mesh: number, part: Mesh) => void): Group {
  const group = new Group();
  group.matrixAutoUpdate = false;
  const material = new MeshLambertMaterial();
  for (const shape of shapes) {
    const part = new Mesh(primitive(shape), material);
    part.userData["body"] = body;
    part.matrixAutoUpdate = false;
    part.matrix.copy(matrix(shape.pose));
    if (shape.mesh !== undefined) {
      part.matrix.scale(part.scale.set(shape.size[0] ?? 1, shape.size[1] ?? 1, shape.size[2] ?? 1));
      bring(shape.mesh, part);
    }
    group.add(part);
  }
  return group;
}

/** Colours a whole group. */
export function tint(group: Group, colour: number): void {
  const part = group.children[0] as Mesh<BufferGeometry, MeshLambertMaterial> | undefined;
  part?.material.color.setHex(colour);
}

/** Long shapes lie along z; in three.js along y. */
function primitive({ kind, size }: Shape): BufferGeometry {
  const [a = 0, b = 0, c = 0] = size;
  switch (kind) {
    case "box":
      return new BoxGeometry(2 * a, 2 * b, 2 * c);
    case "sphere":
      return new SphereGeometry(a, 20, 14);
    case "cylinder":
      return new CylinderGeometry(a, a, 2 * b, 24).rotateX(Math.PI / 2);
    case "capsule":
      return new CapsuleGeometry(a, 2 * b, 6, 18).rotateX(Math.PI / 2);
    case "ellipsoid":
      return new SphereGeometry(1, 20, 14).scale(a, b, c);
    default:
      return new BufferGeometry();
  }
}

/** Facets as they are: vertices are shared between faces of any angle. */
export function faceted({ positions, indices }: Triangles): BufferGeometry {
  const geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(positions, 3)).setIndex(indices);
  const facets = geometry.toNonIndexed();
  facets.computeVertexNormals();
  return facets;
}
