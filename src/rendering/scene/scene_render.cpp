#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCleanPolyData.h>
#include <vtkFeatureEdges.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderStepsPass.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSSAOPass.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rendering/gl/offscreen_window.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/rendering/scene.h"

namespace stackabilization {
namespace {

constexpr double crease_degrees = 35;

/// Single precision of the card suffices once the content sits around the origin at about unit size.
class Stage {
 public:
  Stage(const View& view, int factor);

  void add(const SceneMesh& mesh);
  void add(const SceneLines& lines);
  Image shoot();

 private:
  vtkNew<vtkPolyData> poly_data(const Shape& shape) const;
  void set_point(vtkPoints& points, Eigen::Index i, const Eigen::Vector3d& p) const;
  void add_lights();
  void add_creases(vtkPolyData* surface, const SceneMesh& mesh);

  View view_;
  int factor_;
  double scale_;  ///< stage units per model unit: half the picture's height becomes 1
  detail::OffscreenWindow window_;
  vtkNew<vtkRenderer> renderer_;
};

Stage::Stage(const View& view, int factor)
    : view_(view),
      factor_(factor),
      scale_(view.pixels_per_unit / (view.height / 2.0)),
      window_(view.width * factor, view.height * factor) {
  renderer_->SetBackground(1, 1, 1);
  renderer_->AutomaticLightCreationOff();
  window_.vtk().AddRenderer(renderer_);
  vtkCamera* camera = renderer_->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(1);
  camera->SetPosition(0, 0, 10);
  camera->SetFocalPoint(0, 0, 0);
  camera->SetViewUp(0, 1, 0);
  add_lights();
}

/// A warm key light from the upper left, a cool fill light from the right and a little from below.
void Stage::add_lights() {
  struct Lamp {
    double x, y, z, strength;
  };
  for (const Lamp& lamp : {Lamp{-3, 4.5, 6, 0.57}, Lamp{5, 1, 6, 0.40}, Lamp{0, -4, 5, 0.27}}) {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(lamp.x, lamp.y, lamp.z);
    light->SetFocalPoint(0, 0, 0);
    light->SetIntensity(lamp.strength);
    renderer_->AddLight(light);
  }
}

void Stage::set_point(vtkPoints& points, Eigen::Index i, const Eigen::Vector3d& p) const {
  const Eigen::Vector3d q = scale_ * (p - view_.centre);
  points.SetPoint(i, view_.right.dot(q), view_.up.dot(q), view_.towards.dot(q));
}

vtkNew<vtkPolyData> Stage::poly_data(const Shape& shape) const {
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(shape.vertex_count());
  for (Eigen::Index v = 0; v < shape.vertex_count(); ++v)
    set_point(*points, v, shape.vertices.row(v).transpose());
  vtkNew<vtkTypeInt32Array> corners;
  corners->SetNumberOfValues(shape.triangles.size());
  std::copy_n(shape.triangles.data(), shape.triangles.size(), corners->GetPointer(0));
  vtkNew<vtkCellArray> cells;
  cells->SetData(3, corners);
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  return mesh;
}

void Stage::add_creases(vtkPolyData* surface, const SceneMesh& mesh) {
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(surface);
  edges->SetFeatureAngle(crease_degrees);
  edges->ColoringOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(edges->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  const Colour dark = mix(mesh.colours.front(), palette::ink, 0.65);
  actor->GetProperty()->SetColor(dark.red, dark.green, dark.blue);
  actor->GetProperty()->SetOpacity(mesh.opacity);
  actor->GetProperty()->SetLineWidth(static_cast<float>(0.6 * factor_));
  actor->GetProperty()->LightingOff();
  renderer_->AddActor(actor);
}

void Stage::add(const SceneMesh& mesh) {
  if (mesh.colours.empty()) throw UsageError("a mesh in a scene needs a colour");
  vtkNew<vtkPolyData> surface = poly_data(mesh.shape);
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (const std::int32_t part : mesh.shape.triangle_part) {
    const Colour& c = mesh.colours[std::min(static_cast<std::size_t>(part), mesh.colours.size() - 1)];
    colours->InsertNextTuple3(std::round(255 * c.red), std::round(255 * c.green), std::round(255 * c.blue));
  }
  surface->GetCellData()->SetScalars(colours);

  vtkNew<vtkCleanPolyData> welded;
  welded->SetInputData(surface);
  welded->SetTolerance(0);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(welded->GetOutputPort());
  normals->SetFeatureAngle(crease_degrees);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetOpacity(mesh.opacity);
  property->SetAmbient(mesh.finish == Finish::plain ? 0.9 : 0.34);
  property->SetDiffuse(mesh.finish == Finish::plain ? 0.1 : 0.78);
  property->SetSpecular(mesh.finish == Finish::plain ? 0 : 0.08);
  property->SetSpecularPower(20);
  renderer_->AddActor(actor);
  if (mesh.finish == Finish::shaded) {
    welded->Update();
    add_creases(welded->GetOutput(), mesh);
  }
}

void Stage::add(const SceneLines& lines) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells, dots;
  for (const Points& line : lines.polylines) {
    vtkCellArray& cell = line.rows() == 1 ? *dots : *cells;
    cell.InsertNextCell(static_cast<int>(line.rows()));
    for (Eigen::Index i = 0; i < line.rows(); ++i) {
      const vtkIdType id = points->InsertNextPoint(0, 0, 0);
      set_point(*points, id, line.row(i).transpose());
      cell.InsertCellPoint(id);
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  data->SetVerts(dots);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(lines.colour.red, lines.colour.green, lines.colour.blue);
  actor->GetProperty()->SetLineWidth(static_cast<float>(lines.width * factor_));
  actor->GetProperty()->SetPointSize(static_cast<float>(lines.width * factor_));
  actor->GetProperty()->LightingOff();
  renderer_->AddActor(actor);
}

Image Stage::shoot() {
  renderer_->ResetCameraClippingRange();
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAOPass> occlusion;
  occlusion->SetRadius(0.25);
  occlusion->SetBias(0.02);
  occlusion->SetKernelSize(64);
  occlusion->BlurOn();
  occlusion->SetDelegatePass(steps);
  renderer_->SetPass(occlusion);
  window_.render();
  Image image(view_.width * factor_, view_.height * factor_, palette::white);
  vtkNew<vtkUnsignedCharArray> pixels;
  window_.vtk().GetPixelData(0, 0, image.width - 1, image.height - 1, 0, pixels);
  const std::size_t row = 3 * static_cast<std::size_t>(image.width);
  for (int y = 0; y < image.height; ++y)
    std::copy_n(pixels->GetPointer(static_cast<vtkIdType>(row) * (image.height - 1 - y)), row,
                image.bytes.data() + row * static_cast<std::size_t>(y));
  renderer_->SetPass(nullptr);
  return image;
}

}  // namespace

Image render(const Scene& scene, const View& view, int factor) {
  Stage stage(view, factor);
  for (const SceneMesh& mesh : scene.meshes) stage.add(mesh);
  for (const SceneLines& lines : scene.lines) stage.add(lines);
  return stage.shoot();
}

}  // namespace stackabilization
