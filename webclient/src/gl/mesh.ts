/** Vertex data of passes. */
import type { Pass } from "../generated/api";

type MeshSpec = Pass["mesh"];

export interface Mesh {
  draw(): void;
  dispose(): void;
}

export function meshKey(spec: MeshSpec): string {
  if (spec.rule === "grid") return `grid ${spec.rows} ${spec.columns}`;
  return spec.rule === "fullscreen" ? spec.rule : `${spec.rule} ${spec.count}`;
}

/** Vertices (column/columns, row/rows), columns first, and two triangles a cell. */
export function gridData(rows: number, columns: number): { vertices: Float32Array; indices: Uint32Array } {
  const vertices = new Float32Array((rows + 1) * (columns + 1) * 2);
  let v = 0;
  for (let r = 0; r <= rows; r++) {
    for (let c = 0; c <= columns; c++) {
      vertices[v++] = c / columns;
      vertices[v++] = r / rows;
    }
  }
  const indices = new Uint32Array(rows * columns * 6);
  let i = 0;
  for (let r = 0; r < rows; r++) {
    for (let c = 0; c < columns; c++) {
      const i0 = r * (columns + 1) + c;
      const i1 = i0 + 1;
      const i2 = i0 + columns + 1;
      const i3 = i2 + 1;
      indices.set([i0, i1, i2, i2, i1, i3], i);
      i += 6;
    }
  }
  return { vertices, indices };
}

export function makeMesh(gl: WebGL2RenderingContext, spec: MeshSpec): Mesh {
  const array = gl.createVertexArray();
  if (spec.rule !== "grid") {
    const mode = spec.rule === "points" ? gl.POINTS : gl.TRIANGLES;
    const count = spec.rule === "points" ? spec.count : spec.rule === "quads" ? 6 * spec.count : 3;
    const draw = () => {
      gl.bindVertexArray(array);
      gl.drawArrays(mode, 0, count);
    };
    return { draw, dispose: () => gl.deleteVertexArray(array) };
  }
  const { vertices, indices } = gridData(spec.rows, spec.columns);
  const vertexBuffer = gl.createBuffer();
  const indexBuffer = gl.createBuffer();
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, vertexBuffer);
  gl.bufferData(gl.ARRAY_BUFFER, vertices, gl.STATIC_DRAW);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, indexBuffer);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
  gl.bindVertexArray(null);
  const draw = () => {
    gl.bindVertexArray(array);
    gl.drawElements(gl.TRIANGLES, indices.length, gl.UNSIGNED_INT, 0);
  };
  const dispose = () => {
    gl.deleteVertexArray(array);
    gl.deleteBuffer(vertexBuffer);
    gl.deleteBuffer(indexBuffer);
  };
  return { draw, dispose };
}
