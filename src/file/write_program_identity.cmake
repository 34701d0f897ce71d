# Writes the version and the commit of the sources into a header; touches it only when they change.
# Variables: template, header, version, source_folder.
set(commit unknown)
find_program(git git)
if(git)
  execute_process(COMMAND ${git} rev-parse --verify HEAD WORKING_DIRECTORY ${source_folder}
                  OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
                  RESULT_VARIABLE failed)
  if(NOT failed)
    set(commit ${head})
    execute_process(COMMAND ${git} status --porcelain --untracked-files=no
                    WORKING_DIRECTORY ${source_folder} OUTPUT_VARIABLE changed ERROR_QUIET)
    if(changed)
      string(APPEND commit -dirty)
    endif()
  endif()
endif()
configure_file(${template} ${header} @ONLY)
