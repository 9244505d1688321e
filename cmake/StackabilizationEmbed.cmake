# stackabilization_embed(TARGET SOURCE PATH=FILE ...): adds sources to the target that hold the bytes of these files under
# these paths, see apps/common/embedded_files.h. The assembler reads them, which takes no time to compile; from a source
# of its own, since compiler caches do not see what it reads: for C++ they would return the bytes of older files.
function(stackabilization_embed target source)
  string(REGEX REPLACE "[.]cpp$" ".S" assembly_source ${source})
  set(assembly "")
  set(declarations "")
  set(rows "")
  set(files "")
  set(row 0)
  foreach(entry ${ARGN})
    string(REGEX MATCH "^([^=]+)=(.+)$" matched ${entry})
    set(path ${CMAKE_MATCH_1})
    set(file ${CMAKE_MATCH_2})
    list(APPEND files ${file})
    string(APPEND assembly ".globl embedded_file_${row}, embedded_file_${row}_end
embedded_file_${row}:
.incbin \"${file}\"
embedded_file_${row}_end:
")
    string(APPEND declarations "extern const char embedded_file_${row}[], embedded_file_${row}_end[];\n")
    string(APPEND rows "      {\"${path}\", bytes(embedded_file_${row}, embedded_file_${row}_end)},\n")
    math(EXPR row "${row} + 1")
  endforeach()
  set(text "#include \"apps/common/embedded_files.h\"

extern \"C\" {
${declarations}}

namespace stackabilization::apps {

namespace {

std::string_view bytes(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

const std::vector<EmbeddedFile>& embedded_files() {
  static const std::vector<EmbeddedFile> files = {
${rows}  };
  return files;
}

}  // namespace stackabilization::apps
")
  file(GENERATE OUTPUT ${source} CONTENT "${text}")
  file(GENERATE OUTPUT ${assembly_source} CONTENT ".section .rodata
${assembly}.byte 0
.section .note.GNU-stack,\"\",%progbits
")
  target_sources(${target} PRIVATE ${source} ${assembly_source})
  set_source_files_properties(${assembly_source} PROPERTIES OBJECT_DEPENDS "${files}")
endfunction()
