# BERM_SANITIZE=address,undefined compiles and links everything with those sanitizers.
set(BERM_SANITIZE "" CACHE STRING "Sanitizers, separated by commas")
if(BERM_SANITIZE)
  add_compile_options(-fsanitize=${BERM_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${BERM_SANITIZE})
endif()
