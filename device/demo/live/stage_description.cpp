// Writes descriptions as JSON.
#include "live/stage_description.hpp"

#include <nlohmann/json.hpp>

#include "feeler/core/version.hpp"
#include "feeler/viewer/server.hpp"
#include "feeler/viewer/wire.hpp"
#include "live/tool_choice.hpp"

namespace feeler::demo {
namespace {

using nlohmann::ordered_json;

ordered_json list_of(const Vector3<double>& v) { return {v.x(), v.y(), v.z()}; }

/// Vertices in the tool frame, and faces; of a tool without any, edges as faces of two vertices.
template <class Tool>
ordered_json piece_json(const Tool& tool) {
  ordered_json vertices = ordered_json::array(), faces = ordered_json::array();
  for (int i = 0; i < tool.vertex_count(); ++i) vertices.push_back(list_of(Vector3<double>(tool.vertex(i))));
  for (int i = 0; i < tool.face_count(); ++i) {
    const auto face = tool.face(i);
    faces.push_back(std::vector<int>(face.vertices.begin(), face.vertices.end()));
  }
  if (tool.face_count() == 0) {
    for (int i = 0; i < tool.edge_count(); ++i) faces.push_back({tool.edge(i).start, tool.edge(i).end});
  }
  return {{"vertices", vertices}, {"faces", faces}};
}

ordered_json choice_json(const char* id, const char* label) { return {{"id", id}, {"label", label}}; }

ordered_json gallery_json(const std::vector<GalleryEntry>& gallery) {
  ordered_json entries = ordered_json::array();
  for (const GalleryEntry& entry : gallery) {
    ordered_json variants = ordered_json::array();
    for (const GalleryVariant& variant : entry.variants) variants.push_back(variant.label);
    entries.push_back(
        {{"id", entry.id}, {"title", entry.title}, {"hint", entry.hint}, {"variants", variants}, {"clearance", bool(entry.with_clearance)}});
  }
  return entries;
}

/// Whatever bytes the name of a file has.
std::string text_of(const ordered_json& json) { return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace); }

}  // namespace

std::string hello_text(const std::vector<GalleryEntry>& gallery, double rate, const std::string& device) {
  ordered_json tools = ordered_json::array();
  for (const ToolKind& kind : tool_kinds) tools.push_back(choice_json(kind.id, kind.label));
  return text_of({{"type", "hello"},
                  {"version", FEELER_VERSION},
                  {"wire", viewer::wire_version},
                  {"rate", rate},
                  {"device", device.empty() ? ordered_json(nullptr) : ordered_json(device)},
                  {"gallery", gallery_json(gallery)},
                  {"largest_file", viewer::Server::largest_file},
                  {"tools", tools},
                  {"methods", {choice_json("closest", "closest features"), choice_json("paper", "the paper's, unverified")}},
                  {"scalars", {choice_json("double", "double"), choice_json("float", "float")}}});
}

std::string gallery_text(const std::vector<GalleryEntry>& gallery) { return text_of({{"type", "gallery"}, {"gallery", gallery_json(gallery)}}); }

std::string stage_text(int number, const LiveScene& scene, const StageSettings& stage_settings, const StageOrigin& origin) {
  const scenes::Setting& setting = scene.setting;
  const auto& [settings, choice] = stage_settings;
  ordered_json pieces = ordered_json::array();
  for_each_piece(scene.tool, [&](const auto& piece) { pieces.push_back(piece_json(piece)); });
  const auto& q = setting.start.rotation;
  return text_of({{"type", "stage"},
                  {"stage", number},
                  {"scene", origin.scene},
                  {"variant", origin.variant},
                  {"title", origin.title},
                  {"hint", origin.hint},
                  {"description", setting.description},
                  {"triangles", setting.triangles.rows()},
                  {"clearance", origin.clearance ? ordered_json(*origin.clearance) : ordered_json(nullptr)},
                  {"stiffness", settings.stiffness.translational.x()},
                  {"rotational_stiffness", settings.stiffness.rotational.x()},
                  {"margin", settings.margin},
                  {"tool_kind", origin.tool},
                  {"method", choice.method},
                  {"scalar", choice.scalar},
                  {"tip", list_of(setting.tip)},
                  {"start", {{"position", list_of(setting.start.translation)}, {"orientation", {q.w(), q.x(), q.y(), q.z()}}}},
                  {"tool", pieces}});
}

std::string sentence_text(const char* type, const std::string& sentence) { return text_of({{"type", type}, {"text", sentence}}); }

}  // namespace feeler::demo
