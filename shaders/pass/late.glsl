// SPDX-License-Identifier: MIT
// Uniforms that ways through a kernel depend on, as numbers that are known in the dispatch only,
// though they hold for all of it: lavapipe (Mesa 22) compiles such uniforms in where that makes a
// kernel half as long or longer, anew at each bind, and keeps every copy until the pipeline goes
// (Soak.*).
int late(int number) {
  return number * int(min(gl_NumWorkGroups.x, 1u));
}
bool late(bool condition) {
  return (uint(condition) & min(gl_NumWorkGroups.x, 1u)) != 0u;
}
