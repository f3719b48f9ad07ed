/** The visuals of a robot file as three.js meshes, one group a body. */

import {
  BoxGeometry, BufferGeometry, CapsuleGeometry, CylinderGeometry, Float32BufferAttribute, Group, Mesh, MeshLambertMaterial, SphereGeometry,
} from "three";
import type { Description, Shape } from "../api/types";
import { matrix } from "./frames";

export function shapeGroups(model: Description): Group[] {
  const meshes = new Map<number, BufferGeometry>();
  const mesh = (k: number) => {
    const found = meshes.get(k) ?? meshGeometry(model, k);
    meshes.set(k, found);
    return found;
  };
  return model.bodies.map((body, k) => {
    const group = new Group();
    group.matrixAutoUpdate = false;
    if (body.shapes.length === 0) return group;
    const material = new MeshLambertMaterial();
    for (const shape of body.shapes) {
      const part = new Mesh(shape.kind === "mesh" ? mesh(shape.mesh ?? 0) : primitive(shape), material);
      part.userData["body"] = k;
      part.matrixAutoUpdate = false;
      part.matrix.copy(matrix(shape.pose));
      if (shape.kind === "mesh") part.matrix.scale(part.scale.set(shape.size[0] ?? 1, shape.size[1] ?? 1, shape.size[2] ?? 1));
      group.add(part);
    }
    return group;
  });
}

/** Colours a whole body. */
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
    case "cylinder":
      return new CylinderGeometry(a, a, 2 * b, 24).rotateX(Math.PI / 2);
    case "capsule":
      return new CapsuleGeometry(a, 2 * b, 6, 18).rotateX(Math.PI / 2);
    case "ellipsoid":
      return new SphereGeometry(1, 20, 14).scale(a, b, c);
    default:
      return new SphereGeometry(a, 20, 14);
  }
}

function meshGeometry(model: Description, k: number): BufferGeometry {
  const geometry = new BufferGeometry();
  const mesh = model.meshes[k];
  if (!mesh) return geometry;
  geometry.setAttribute("position", new Float32BufferAttribute(mesh.positions, 3));
  geometry.setIndex(mesh.indices);
  // Facets as they are: vertices are shared between faces of any angle.
  const facets = geometry.toNonIndexed();
  facets.computeVertexNormals();
  return facets;
}
