#include "generator/models.h"

namespace stackabilization::models {

std::vector<Model> all_models() {
  return {{"armchair", armchair()},
          {"basket", basket()},
          {"bottle", bottle()},
          {"bowl", bowl()},
          {"bucket_with_handles", bucket_with_handles()},
          {"chair", chair()},
          {"crate", crate()},
          {"cup", cup()},
          {"hat", hat()},
          {"mug_with_handle", mug_with_handle()},
          {"pot_with_handle", pot_with_handle()},
          {"stool", stool()},
          {"swivel_chair", swivel_chair()},
          {"table", table()},
          {"zigzag_chair", zigzag_chair()}};
}

}  // namespace stackabilization::models
