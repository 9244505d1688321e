#include <algorithm>
#include <array>

#include "rendering/drawing/plot_parts.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/rendering/foot.h"
#include "stackabilization/rendering/pictures.h"
#include "stackabilization/rendering/scene.h"
#include "stackabilization/rendering/stacking_scene.h"

namespace stackabilization {
namespace {

constexpr int max_copies = 200;

/// One of the two stacks: its lowest copy on its foot at the origin, moved by `shift`.
struct Stack {
  Shape lowest;
  double step = 0;  ///< from copy to copy, model units
  Colour colour;
  Range across{}, along{};  ///< of the lowest copy at the origin, to the right in the picture and along r
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();

  double height(int copies) const { return along.length() + (copies - 1) * step; }
};

Stack stack_of(const MeasuredShape& measured, const Colour& colour, const Eigen::Vector3d& right) {
  const Direction up(measured.measured.direction);
  Stack stack;
  stack.lowest = transformed(measured.shape, Eigen::Matrix3d::Identity(), -foot_of(measured.shape, up));
  stack.step = measured.measured.f_max;
  stack.colour = colour;
  stack.across = range_along(stack.lowest, right);
  stack.along = range_along(stack.lowest, up.unit());
  return stack;
}

/// Both stacks on the same ground, with a gap between them: a larger one for tall stacks, which leave space
/// in the picture.
std::array<Stack, 2> stacks_of(const ImprovedShape& shapes, int copies, const Eigen::Vector3d& right) {
  constexpr double gap_of_width = 0.8, gap_of_height = 0.3;
  std::array<Stack, 2> stacks{stack_of(shapes.before, palette::input, right),
                              stack_of(shapes.after, palette::output, right)};
  const double width = std::max(stacks[0].across.length(), stacks[1].across.length());
  const double height = std::max(stacks[0].height(copies), stacks[1].height(copies));
  const double gap = std::max(gap_of_width * width, gap_of_height * height);
  stacks[1].shift = (stacks[0].across.high + gap - stacks[1].across.low) * right;
  return stacks;
}

/// Layout of the picture.
struct StackPlace {
  const View& view;
  Rectangle place;
  Eigen::Vector3d up;
  double text_size;

  Eigen::Vector2d at(const Eigen::Vector3d& point) const {
    return Eigen::Vector2d(place.x, place.y) + view.project(point);
  }
};

/// Height of a stack at its left, and its caption below.
detail::Elements labels_of(const Stack& stack, const std::string& name, int copies, const StackPlace& stage) {
  const double size = stage.text_size, height = stack.height(copies);
  const Eigen::Vector3d& right = stage.view.right;
  const double from = stage.at(stack.shift).y(), to = stage.at(stack.shift + height * stage.up).y();
  const double left_end = stage.at(stack.shift + stack.across.low * right).x();
  const double right_end = stage.at(stack.shift + stack.across.high * right).x();
  detail::Elements elements = detail::vertical_dimension(
      {left_end - size, from, to, detail::length_text(height, stack.lowest.unit), Anchor::left}, size);
  elements.emplace_back(Text{{(left_end + right_end) / 2, stage.place.bottom() + 1.6 * size},
                             name + ": " + std::to_string(copies) + (copies == 1 ? " copy" : " copies"),
                             1.1 * size,
                             palette::ink,
                             Anchor::centre});
  return elements;
}

}  // namespace

Drawing stacks_picture(const ImprovedShape& shapes, const StacksPictureOptions& options) {
  if (shapes.before.measured.direction != shapes.after.measured.direction)
    throw UsageError("a picture of two stacks needs both measured along the same direction");
  if (options.copies < 1 || options.copies > max_copies)
    throw UsageError("a picture of stacks draws 1 to 200 copies, found " + std::to_string(options.copies));
  const Direction direction(shapes.after.measured.direction);
  const Eigen::Vector3d up = direction.unit();
  const double size = options.width / 60.0, margin = 1.5 * size, dimension_room = 3 * size, foot = 3 * size;
  Drawing drawing{options.width, options.height, {}};
  const detail::Heading heading = detail::heading(options.title, options.notes, options.width, size);
  drawing.add(heading.elements);
  const double top = heading.bottom + size, left = margin + dimension_room;
  const Rectangle place{left, top, options.width - left - margin,
                        std::max(options.height - top - foot, size)};
  ViewOptions view_options;
  view_options.width = static_cast<int>(place.width);
  view_options.height = static_cast<int>(place.height);
  view_options.elevation_degrees = 10;
  const std::array<Stack, 2> stacks =
      stacks_of(shapes, options.copies, turned_view(direction, view_options).right);
  Scene scene;
  for (const Stack& stack : stacks)
    scene.add(stack_scene(copies_of(transformed(stack.lowest, Eigen::Matrix3d::Identity(), stack.shift),
                                    stack.step * up, options.copies),
                          stack.colour));
  const View view = fit_view(scene, direction, view_options);
  drawing.add(PlacedImage{place, render(scene, view)});
  const StackPlace stage{view, place, up, size};
  drawing.add(labels_of(stacks[0], "before", options.copies, stage));
  drawing.add(labels_of(stacks[1], "after", options.copies, stage));
  return drawing;
}

}  // namespace stackabilization
