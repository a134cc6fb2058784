# berm_compile_form(NAME FILE.py): UFL -> C by ffcx at build time; target berm_form_NAME.
function(berm_compile_form name file)
  set(dir "${CMAKE_CURRENT_BINARY_DIR}/forms")
  file(MAKE_DIRECTORY "${dir}")
  add_custom_command(
    OUTPUT "${dir}/${name}.c" "${dir}/${name}.h"
    COMMAND "${BERM_FFCX}" -o "${dir}" "${file}"
    DEPENDS "${file}"
    COMMENT "ffcx ${name}.py")
  add_library(berm_form_${name} STATIC "${dir}/${name}.c")
  target_include_directories(berm_form_${name} PUBLIC "${dir}")
  target_include_directories(berm_form_${name} SYSTEM PUBLIC $<TARGET_PROPERTY:dolfinx,INTERFACE_INCLUDE_DIRECTORIES>)
endfunction()
