// SPDX-License-Identifier: MIT
// Where the rays of pixels cross the triangles of a closed surface, without clipping (Olano and
// Greer 1997) and without cracks: the sides of a shared edge are each other's exact negative.
//
// A vertex is homogeneous, (x W, y W, W): the pixel that sees it, x to the right and y down, and
// its depth W along the view, negative behind the eye. Parallel projections have W = 1.

// The line through two vertices. `first` is the one with the lower number, whatever triangle asks:
// so both triangles of an edge compute the same three numbers; `turned` changes their signs.
vec3 edgeLine(vec3 first, vec3 second, bool turned) {
  vec3 line = vec3(first.y * second.z - first.z * second.y, first.z * second.x - first.x * second.z,
                   first.x * second.y - first.y * second.x);
  return turned ? -line : line;
}

real lineAt(vec3 line, vec2 pixel) {
  return line.x * pixel.x + line.y * pixel.y + line.z;
}

// 1 or -1; of a pixel on the line that of a point infinitely little to the right of it, else below.
// 0: no line, since the eye looks along the edge.
real lineSide(vec3 line, real at) {
  real x = line.x != real(0.0f) ? line.x : line.y;
  return sign(at != real(0.0f) ? at : x);
}

struct SurfaceCrossing {
  real facing;  // 1: front, whose vertices run against the clock; -1: back; 0: none
  real depth;   // between those of the vertices; crossings below 0 lie behind the eye
};

// line0 is the one that does not meet vertex 0, and so on; `depths` are the vertices' own: W, or
// along a parallel projection what is asked for.
SurfaceCrossing surfaceCrossing(vec3 line0, vec3 line1, vec3 line2, vec3 depths, vec2 pixel) {
  vec3 at = vec3(lineAt(line0, pixel), lineAt(line1, pixel), lineAt(line2, pixel));
  real side = lineSide(line0, at.x);
  bool one = side == lineSide(line1, at.y) && side == lineSide(line2, at.z);
  vec3 weight = abs(at);
  real sum = weight.x + weight.y + weight.z;
  SurfaceCrossing result;
  result.facing = one ? -side : real(0.0f);  // y points down
  // A pixel on all three lines sees a triangle of no size.
  result.depth = sum > real(0.0f) ? dot(weight, depths) / sum
                                  : (depths.x + depths.y + depths.z) / real(3.0f);
  return result;
}
