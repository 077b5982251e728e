// SPDX-License-Identifier: MIT
//
// What the module of bullet_f32_module.cc offers: plain C, for the two flavours of Bullet have the
// same names for different functions and may not meet in one name space of the loader.
#ifndef TOUCHSTONE_TOOLS_ENGINES_BULLET_F32_MODULE_H_
#define TOUCHSTONE_TOOLS_ENGINES_BULLET_F32_MODULE_H_

extern "C" {

enum TouchstoneBulletAnswer {
  kTouchstoneBulletSeparate,
  kTouchstoneBulletOverlap,
  kTouchstoneBulletUndecided,
};

// All functions in one table, found as the symbol "touchstone_bullet_f32".
struct TouchstoneBulletFunctions {
  // A hull of `count` points, x y z each, rounded to float.
  void* (*make_shape)(const double* points, int count);
  void (*free_shape)(void* shape);
  // `pose` is 3x4, row-major, rounded to float. `guess`, x y z, is where the search starts unless
  // it is zero, and gets where it ended.
  TouchstoneBulletAnswer (*ask)(const void* p, const void* q, const float* pose, float* guess);
  // The distance, or with `want_depth` the depth; false where there is none.
  bool (*measure)(const void* p, const void* q, const float* pose, bool want_depth, double* value);
};

}  // extern "C"

#endif  // TOUCHSTONE_TOOLS_ENGINES_BULLET_F32_MODULE_H_
