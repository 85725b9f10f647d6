; sources 075044a6b57faee3451bea655de1e0f8, text 4e97cac70aa8d6b09e9a9e6d544f1b9b


@_ZN08NumbaEnv18biped_adrc_kernels7load_ofB2v1B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels4flowB2v3B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels9remainderB2v9B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5watchB3v10B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels4nodeB3v11B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels3dueB3v13B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels4noteB2v8B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7laggingB3v20B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2ad10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels11relax_slopeB3v23B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels9classicalB3v24B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2a10float64_2ad10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5relaxB3v22B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels11exponentialB3v26B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axdd10float64_2a10float64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6matrixB3v27B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax23Literal_5bint_5d_280_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6matrixB3v28B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax23Literal_5bint_5d_281_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6matrixB3v29B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax23Literal_5bint_5d_284_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6matvecB3v30B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels3addB2v2B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ad10float64_2a10float64_2ax = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels11apply_inputB3v31B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6matrixB3v32B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax23Literal_5bint_5d_282_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6matrixB3v33B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax23Literal_5bint_5d_283_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6matrixB3v34B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax23Literal_5bint_5d_285_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7rk4_sumB3v25B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ad10float64_2a10float64_2a10float64_2a10float64_2a10float64_2ax = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5halveB3v35B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axdddd = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython7numbers14int_power_impl12_3clocals_3e9int_powerB3v37B42c8tJTC_2fWQA93W1AaAIYBPIqRBFCjDSZRVAJmaQIAEdx = weak local_unnamed_addr global ptr null
@.const.pickledata.8928cf367dcdb5b06f67cce68474c0d77d61c7bd = internal constant [133 x i8] c"\80\04\95z\00\00\00\00\00\00\00\8C\08builtins\94\8C\0DOverflowError\94\93\94)\8C\09int_power\94\8CF/work/main/.venv/lib/python3.11/site-packages/numba/cpython/numbers.py\94K\DE\87\94\87\94."
@.const.pickledata.8928cf367dcdb5b06f67cce68474c0d77d61c7bd.sha1 = internal constant [20 x i8] c"\89(\CF6}\CD\B5\B0og\CC\E6\84t\C0\D7}a\C7\BD"
@.const.picklebuf.8928cf367dcdb5b06f67cce68474c0d77d61c7bd = internal constant { ptr, i32, ptr, ptr, i32 } { ptr @.const.pickledata.8928cf367dcdb5b06f67cce68474c0d77d61c7bd, i32 133, ptr @.const.pickledata.8928cf367dcdb5b06f67cce68474c0d77d61c7bd.sha1, ptr null, i32 0 }
@.const.pickledata.b28008a0f88bad5ff0f0243e84dab90cab19b366 = internal constant [69 x i8] c"\80\04\95:\00\00\00\00\00\00\00\8C\08builtins\94\8C\11ZeroDivisionError\94\93\94\8C\10division by zero\94\85\94N\87\94."
@.const.pickledata.b28008a0f88bad5ff0f0243e84dab90cab19b366.sha1 = internal constant [20 x i8] c"\B2\80\08\A0\F8\8B\AD_\F0\F0$>\84\DA\B9\0C\AB\19\B3f"
@.const.picklebuf.b28008a0f88bad5ff0f0243e84dab90cab19b366 = internal constant { ptr, i32, ptr, ptr, i32 } { ptr @.const.pickledata.b28008a0f88bad5ff0f0243e84dab90cab19b366, i32 69, ptr @.const.pickledata.b28008a0f88bad5ff0f0243e84dab90cab19b366.sha1, ptr null, i32 0 }
@_ZN08NumbaEnv18biped_adrc_kernels6retakeB3v38B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6locateB3v41B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axddd = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5brentB3v42B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd10float64_2a10float64_2adddd = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5reachB3v39B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2ad = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5denseB3v40B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels4liftB3v43B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7overdueB3v45B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6passedB3v46B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5eventB3v50B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels10begins_lowB3v53B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7suspectB3v54B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2addx = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7hermiteB3v55B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7crossedB3v48B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2addd = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7code_ofB3v47B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5fixedB3v56B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2addx = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels4joinB3v36B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels4slowB3v57B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7throughB3v58B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_max12_3clocals_3e4implB3v60B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dE15StarArgUniTupleIdLi2EE = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5beginB3v61B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5splitB3v62B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5solveB3v64B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels4stopB3v66B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6brokenB3v19B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5nodesB3v67B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6piecesB3v51B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAEdd = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7pass_onB3v68B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5go_onB3v69B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels3armB3v71B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6travelB3v72B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels4keepB3v63B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels4landB3v76B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels13land_and_noteB3v77B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6strideB3v78B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6sampleB3v79B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels4lookB3v80B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5lowerB3v70B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7measureB3v16B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7disturbB2v6B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels8set_timeB2v7B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels4pushB3v81B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5looksB3v82B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axx8int64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels10move_aloneB3v83B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_min12_3clocals_3e4implB2v5B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dE15StarArgUniTupleIdLi2EE = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels8is_plainB3v85B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels10next_breakB3v73B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_min12_3clocals_3e4implB3v17B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dE15StarArgUniTupleIdLi2EE = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7is_tickB3v15B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAEddd = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels11next_switchB3v74B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels3getB3v91B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels11put_numbersB3v92B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5leaveB3v93B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels12begin_sampleB3v98B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels9tick_timeB3v84B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels12release_timeB3v89B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels9next_tickB3v75B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAEddd = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_max12_3clocals_3e4implB3v52B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dE15StarArgUniTupleIxLi2EE = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5enterB4v102B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB3v95B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_289_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB3v96B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2811_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB4v103B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_284_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB4v104B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_285_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB4v105B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_286_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels11store_nodesB4v106B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_min12_3clocals_3e4implB3v12B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dE15StarArgUniTupleIxLi2EE = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7set_endB4v108B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axx10float64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB4v109B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2812_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels4leftB3v59B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAEd = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels10relaxationB3v21B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAEd = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels10take_stepsB4v112B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a10float64_2axx = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB4v107B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ax = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB4v110B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_282_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB4v111B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_283_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels10sample_allB4v114B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5stepsB3v86B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_max12_3clocals_3e4implB3v87B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dE15StarArgUniTupleIdLi2EE = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_int12_3clocals_3e4implB3v88B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dEd = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB3v94B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_280_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB4v100B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_288_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB3v99B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_287_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels12side_by_sideB4v115B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a8int64_2ax8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels11move_besideB4v116B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a8int64_2ax8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_max12_3clocals_3e4implB4v117B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dE15StarArgUniTupleIxLi2EE = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB4v118B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2815_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB4v113B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_281_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB3v97B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2814_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7part_ofB4v101B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2810_29 = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7samplesB4v119B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axx10float64_2a10float64_2a8int64_2a8int64_2a8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_int12_3clocals_3e4implB4v120B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dEd = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_int12_3clocals_3e4implB3v65B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dEb = weak local_unnamed_addr global ptr null

define i32 @_ZN18biped_adrc_kernels7load_ofB2v1B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.r) local_unnamed_addr {
B0.endif:
  %.8 = getelementptr i8, ptr %arg.r, i64 72
  %.9 = load i64, ptr %.8, align 8
  %.9.fr = freeze i64 %.9
  %.10 = add i64 %.9.fr, 2
  %.12 = getelementptr i8, ptr %arg.r, i64 312
  %.13 = load i64, ptr %.12, align 8
  %.59 = icmp slt i64 %.9.fr, -1
  %..10 = select i1 %.59, i64 0, i64 %.10
  %.10383 = icmp sgt i64 %..10, 0
  br i1 %.10383, label %B70.lr.ph, label %B94.endif

B70.lr.ph:
  %xtraiter = and i64 %..10, 7
  %0 = icmp samesign ult i64 %..10, 8
  br i1 %0, label %B70.epil.preheader, label %B70.lr.ph.new

B70.lr.ph.new:
  %unroll_iter = and i64 %..10, 9223372036854775800
  %sunkaddr = getelementptr i8, ptr %arg.r, i64 656
  br label %B70

B70:
  %.1098284 = phi i64 [ 0, %B70.lr.ph.new ], [ %.116.7, %B70 ]
  %.143 = load i64, ptr %sunkaddr, align 8
  %.144 = inttoptr i64 %.143 to ptr
  %1 = shl i64 %.1098284, 3
  %scevgep111 = getelementptr i8, ptr %.144, i64 %1
  store double 0.000000e+00, ptr %scevgep111, align 8
  %.143.1 = load i64, ptr %sunkaddr, align 8
  %.144.1 = inttoptr i64 %.143.1 to ptr
  %scevgep109 = getelementptr i8, ptr %.144.1, i64 8
  %scevgep110 = getelementptr i8, ptr %scevgep109, i64 %1
  store double 0.000000e+00, ptr %scevgep110, align 8
  %.143.2 = load i64, ptr %sunkaddr, align 8
  %.144.2 = inttoptr i64 %.143.2 to ptr
  %scevgep107 = getelementptr i8, ptr %.144.2, i64 16
  %scevgep108 = getelementptr i8, ptr %scevgep107, i64 %1
  store double 0.000000e+00, ptr %scevgep108, align 8
  %.143.3 = load i64, ptr %sunkaddr, align 8
  %.144.3 = inttoptr i64 %.143.3 to ptr
  %scevgep105 = getelementptr i8, ptr %.144.3, i64 24
  %scevgep106 = getelementptr i8, ptr %scevgep105, i64 %1
  store double 0.000000e+00, ptr %scevgep106, align 8
  %.143.4 = load i64, ptr %sunkaddr, align 8
  %.144.4 = inttoptr i64 %.143.4 to ptr
  %scevgep103 = getelementptr i8, ptr %.144.4, i64 32
  %scevgep104 = getelementptr i8, ptr %scevgep103, i64 %1
  store double 0.000000e+00, ptr %scevgep104, align 8
  %.143.5 = load i64, ptr %sunkaddr, align 8
  %.144.5 = inttoptr i64 %.143.5 to ptr
  %scevgep101 = getelementptr i8, ptr %.144.5, i64 40
  %scevgep102 = getelementptr i8, ptr %scevgep101, i64 %1
  store double 0.000000e+00, ptr %scevgep102, align 8
  %.143.6 = load i64, ptr %sunkaddr, align 8
  %.144.6 = inttoptr i64 %.143.6 to ptr
  %scevgep99 = getelementptr i8, ptr %.144.6, i64 48
  %scevgep100 = getelementptr i8, ptr %scevgep99, i64 %1
  store double 0.000000e+00, ptr %scevgep100, align 8
  %.116.7 = add nuw nsw i64 %.1098284, 8
  %.143.7 = load i64, ptr %sunkaddr, align 8
  %.144.7 = inttoptr i64 %.143.7 to ptr
  %scevgep97 = getelementptr i8, ptr %.144.7, i64 56
  %scevgep98 = getelementptr i8, ptr %scevgep97, i64 %1
  store double 0.000000e+00, ptr %scevgep98, align 8
  %niter.ncmp.7 = icmp eq i64 %unroll_iter, %.116.7
  br i1 %niter.ncmp.7, label %B94.endif.loopexit.unr-lcssa, label %B70

B136:
  %.280 = phi i64 [ %.336, %B136.endif.loopexit ], [ %.280.pre, %B136.preheader ]
  %K.2.092 = phi ptr [ %.343, %B136.endif.loopexit ], [ %7, %B136.preheader ]
  %.2468890 = phi i64 [ %.253, %B136.endif.loopexit ], [ 0, %B136.preheader ]
  %.281 = inttoptr i64 %.280 to ptr
  %.282 = shl nuw nsw i64 %.2468890, 1
  %.283 = getelementptr i64, ptr %.281, i64 %.282
  %.284 = load i64, ptr %.283, align 8
  %.287 = load i64, ptr %sunkaddr116, align 8
  %.288 = inttoptr i64 %.287 to ptr
  %.291 = load i64, ptr %sunkaddr117, align 8
  %.292 = inttoptr i64 %.291 to ptr
  %.294 = inttoptr i64 %.284 to ptr
  tail call void %.294(ptr %K.2.092, ptr %.288, ptr %.292)
  %.299 = load i64, ptr %sunkaddr114, align 8
  %.303 = load i64, ptr %sunkaddr117, align 8
  %.pre = inttoptr i64 %.303 to ptr
  %.pre7 = inttoptr i64 %.299 to ptr
  br i1 %8, label %B36.i.preheader, label %B36.prol.i

B36.prol.i:
  %.1043941.prol.i = phi i64 [ %.111.prol.i, %B36.prol.i ], [ 0, %B136 ]
  %.111.prol.i = add nuw nsw i64 %.1043941.prol.i, 1
  %2 = shl nuw nsw i64 %.1043941.prol.i, 3
  %scevgep57 = getelementptr i8, ptr %.pre7, i64 %2
  %.138.prol.i = load double, ptr %scevgep57, align 8, !noalias !0
  %scevgep56 = getelementptr i8, ptr %.pre, i64 %2
  %.141.prol.i = load double, ptr %scevgep56, align 8, !noalias !0
  %.144.prol.i = fadd double %.138.prol.i, %.141.prol.i
  store double %.144.prol.i, ptr %scevgep57, align 8, !noalias !0
  %prol.iter.cmp.not.i = icmp eq i64 %xtraiter.i, %.111.prol.i
  br i1 %prol.iter.cmp.not.i, label %B36.i.preheader, label %B36.prol.i, !llvm.loop !3

B36.i.preheader:
  %scevgep60 = getelementptr i8, ptr %.pre, i64 56
  %scevgep61 = getelementptr i8, ptr %scevgep60, i64 %10
  %scevgep77 = getelementptr i8, ptr %.pre7, i64 56
  %scevgep78 = getelementptr i8, ptr %scevgep77, i64 %10
  br label %B36.i

B36.i:
  %lsr.iv58 = phi i64 [ -2, %B36.i.preheader ], [ %lsr.iv.next59, %B36.i ]
  %3 = shl i64 %lsr.iv58, 3
  %scevgep79 = getelementptr i8, ptr %scevgep78, i64 %3
  %scevgep80 = getelementptr i8, ptr %scevgep79, i64 -40
  %.138.i = load double, ptr %scevgep80, align 8, !noalias !0
  %scevgep75 = getelementptr i8, ptr %scevgep61, i64 %3
  %scevgep76 = getelementptr i8, ptr %scevgep75, i64 -40
  %.141.i = load double, ptr %scevgep76, align 8, !noalias !0
  %.144.i = fadd double %.138.i, %.141.i
  store double %.144.i, ptr %scevgep80, align 8, !noalias !0
  %scevgep93 = getelementptr i8, ptr %scevgep79, i64 -32
  %.138.1.i = load double, ptr %scevgep93, align 8, !noalias !0
  %scevgep74 = getelementptr i8, ptr %scevgep75, i64 -32
  %.141.1.i = load double, ptr %scevgep74, align 8, !noalias !0
  %.144.1.i = fadd double %.138.1.i, %.141.1.i
  store double %.144.1.i, ptr %scevgep93, align 8, !noalias !0
  %scevgep91 = getelementptr i8, ptr %scevgep79, i64 -24
  %.138.2.i = load double, ptr %scevgep91, align 8, !noalias !0
  %scevgep72 = getelementptr i8, ptr %scevgep75, i64 -24
  %.141.2.i = load double, ptr %scevgep72, align 8, !noalias !0
  %.144.2.i = fadd double %.138.2.i, %.141.2.i
  store double %.144.2.i, ptr %scevgep91, align 8, !noalias !0
  %scevgep89 = getelementptr i8, ptr %scevgep79, i64 -16
  %.138.3.i = load double, ptr %scevgep89, align 8, !noalias !0
  %scevgep70 = getelementptr i8, ptr %scevgep75, i64 -16
  %.141.3.i = load double, ptr %scevgep70, align 8, !noalias !0
  %.144.3.i = fadd double %.138.3.i, %.141.3.i
  store double %.144.3.i, ptr %scevgep89, align 8, !noalias !0
  %scevgep87 = getelementptr i8, ptr %scevgep79, i64 -8
  %.138.4.i = load double, ptr %scevgep87, align 8, !noalias !0
  %scevgep68 = getelementptr i8, ptr %scevgep75, i64 -8
  %.141.4.i = load double, ptr %scevgep68, align 8, !noalias !0
  %.144.4.i = fadd double %.138.4.i, %.141.4.i
  store double %.144.4.i, ptr %scevgep87, align 8, !noalias !0
  %.138.5.i = load double, ptr %scevgep79, align 8, !noalias !0
  %.141.5.i = load double, ptr %scevgep75, align 8, !noalias !0
  %.144.5.i = fadd double %.138.5.i, %.141.5.i
  store double %.144.5.i, ptr %scevgep79, align 8, !noalias !0
  %scevgep84 = getelementptr i8, ptr %scevgep79, i64 8
  %.138.6.i = load double, ptr %scevgep84, align 8, !noalias !0
  %scevgep65 = getelementptr i8, ptr %scevgep75, i64 8
  %.141.6.i = load double, ptr %scevgep65, align 8, !noalias !0
  %.144.6.i = fadd double %.138.6.i, %.141.6.i
  store double %.144.6.i, ptr %scevgep84, align 8, !noalias !0
  %scevgep82 = getelementptr i8, ptr %scevgep79, i64 16
  %.138.7.i = load double, ptr %scevgep82, align 8, !noalias !0
  %scevgep63 = getelementptr i8, ptr %scevgep75, i64 16
  %.141.7.i = load double, ptr %scevgep63, align 8, !noalias !0
  %.144.7.i = fadd double %.138.7.i, %.141.7.i
  store double %.144.7.i, ptr %scevgep82, align 8, !noalias !0
  %lsr.iv.next59 = add i64 %lsr.iv58, 8
  %exitcond.not.7.i = icmp eq i64 %9, %lsr.iv.next59
  br i1 %exitcond.not.7.i, label %B136.endif.loopexit, label %B36.i, !llvm.loop !5

common.ret:
  store ptr null, ptr %retptr, align 8
  ret i32 0

B94.endif.loopexit.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B94.endif, label %B70.epil.preheader

B70.epil.preheader:
  %.1098284.epil.init = phi i64 [ 0, %B70.lr.ph ], [ %unroll_iter, %B94.endif.loopexit.unr-lcssa ]
  %sunkaddr115 = getelementptr i8, ptr %arg.r, i64 656
  br label %B70.epil

B70.epil:
  %lsr.iv95 = phi i64 [ %lsr.iv.next96, %B70.epil ], [ %xtraiter, %B70.epil.preheader ]
  %.1098284.epil = phi i64 [ %.116.epil, %B70.epil ], [ %.1098284.epil.init, %B70.epil.preheader ]
  %.116.epil = add nuw nsw i64 %.1098284.epil, 1
  %.143.epil = load i64, ptr %sunkaddr115, align 8
  %.144.epil = inttoptr i64 %.143.epil to ptr
  %4 = shl i64 %.1098284.epil, 3
  %scevgep94 = getelementptr i8, ptr %.144.epil, i64 %4
  store double 0.000000e+00, ptr %scevgep94, align 8
  %lsr.iv.next96 = add nsw i64 %lsr.iv95, -1
  %epil.iter.cmp.not = icmp eq i64 %lsr.iv.next96, 0
  br i1 %epil.iter.cmp.not, label %B94.endif, label %B70.epil, !llvm.loop !7

B94.endif:
  %.159 = getelementptr i8, ptr %arg.r, i64 200
  %.160 = load i64, ptr %.159, align 8
  %.24089.not = icmp slt i64 %.160, 1
  br i1 %.24089.not, label %common.ret, label %B136.lr.ph

B136.lr.ph:
  %.279 = getelementptr i8, ptr %arg.r, i64 320
  %.280.pre = load i64, ptr %.279, align 8
  %xtraiter.i = and i64 %.10, 7
  %sunkaddr116 = getelementptr i8, ptr %arg.r, i64 640
  %sunkaddr117 = getelementptr i8, ptr %arg.r, i64 664
  br i1 %.59, label %B136.us.preheader, label %B136.lr.ph.split

B136.us.preheader:
  %5 = inttoptr i64 %.13 to ptr
  br label %B136.us

B136.us:
  %lsr.iv43 = phi i64 [ 0, %B136.us.preheader ], [ %lsr.iv.next44, %B136.us ]
  %lsr.iv = phi i64 [ %.160, %B136.us.preheader ], [ %lsr.iv.next, %B136.us ]
  %.280.us = phi i64 [ %.280.pre, %B136.us.preheader ], [ %.336.us, %B136.us ]
  %K.2.092.us = phi ptr [ %5, %B136.us.preheader ], [ %.343.us, %B136.us ]
  %.281.us = inttoptr i64 %.280.us to ptr
  %scevgep46 = getelementptr i8, ptr %.281.us, i64 %lsr.iv43
  %.284.us = load i64, ptr %scevgep46, align 8
  %.287.us = load i64, ptr %sunkaddr116, align 8
  %.288.us = inttoptr i64 %.287.us to ptr
  %.291.us = load i64, ptr %sunkaddr117, align 8
  %.292.us = inttoptr i64 %.291.us to ptr
  %.294.us = inttoptr i64 %.284.us to ptr
  tail call void %.294.us(ptr %K.2.092.us, ptr %.288.us, ptr %.292.us)
  %.336.us = load i64, ptr %.279, align 8
  %.337.us = inttoptr i64 %.336.us to ptr
  %scevgep = getelementptr i8, ptr %.337.us, i64 8
  %scevgep45 = getelementptr i8, ptr %scevgep, i64 %lsr.iv43
  %.341.us = load i64, ptr %scevgep45, align 8
  %.343.us = getelementptr double, ptr %K.2.092.us, i64 %.341.us
  %lsr.iv.next = add i64 %lsr.iv, -1
  %lsr.iv.next44 = add i64 %lsr.iv43, 16
  %exitcond96.not.us = icmp eq i64 %lsr.iv.next, 0
  br i1 %exitcond96.not.us, label %common.ret, label %B136.us

B136.lr.ph.split:
  %6 = icmp slt i64 %.9.fr, 6
  br i1 %6, label %B136.lr.ph.split.split.us, label %B136.preheader

B136.preheader:
  %7 = inttoptr i64 %.13 to ptr
  %8 = icmp eq i64 %xtraiter.i, 0
  %sunkaddr114 = getelementptr i8, ptr %arg.r, i64 656
  %9 = sub nsw i64 %.9.fr, %xtraiter.i
  %10 = shl nuw nsw i64 %xtraiter.i, 3
  br label %B136

B136.lr.ph.split.split.us:
  %11 = icmp eq i64 %xtraiter.i, 0
  %12 = inttoptr i64 %.13 to ptr
  br i1 %11, label %B136.us2.us, label %B136.us2.preheader

B136.us2.preheader:
  %sunkaddr124 = getelementptr i8, ptr %arg.r, i64 656
  br label %B136.us2

B136.us2.us:
  %lsr.iv50 = phi i64 [ %lsr.iv.next51, %B136.us2.us ], [ 0, %B136.lr.ph.split.split.us ]
  %lsr.iv47 = phi i64 [ %lsr.iv.next48, %B136.us2.us ], [ %.160, %B136.lr.ph.split.split.us ]
  %.280.us3.us = phi i64 [ %.336.us21.us, %B136.us2.us ], [ %.280.pre, %B136.lr.ph.split.split.us ]
  %K.2.092.us4.us = phi ptr [ %.343.us25.us, %B136.us2.us ], [ %12, %B136.lr.ph.split.split.us ]
  %.281.us6.us = inttoptr i64 %.280.us3.us to ptr
  %scevgep53 = getelementptr i8, ptr %.281.us6.us, i64 %lsr.iv50
  %.284.us9.us = load i64, ptr %scevgep53, align 8
  %.287.us10.us = load i64, ptr %sunkaddr116, align 8
  %.288.us11.us = inttoptr i64 %.287.us10.us to ptr
  %.291.us12.us = load i64, ptr %sunkaddr117, align 8
  %.292.us13.us = inttoptr i64 %.291.us12.us to ptr
  %.294.us14.us = inttoptr i64 %.284.us9.us to ptr
  tail call void %.294.us14.us(ptr %K.2.092.us4.us, ptr %.288.us11.us, ptr %.292.us13.us)
  %.336.us21.us = load i64, ptr %.279, align 8
  %.337.us22.us = inttoptr i64 %.336.us21.us to ptr
  %scevgep49 = getelementptr i8, ptr %.337.us22.us, i64 8
  %scevgep52 = getelementptr i8, ptr %scevgep49, i64 %lsr.iv50
  %.341.us24.us = load i64, ptr %scevgep52, align 8
  %.343.us25.us = getelementptr double, ptr %K.2.092.us4.us, i64 %.341.us24.us
  %lsr.iv.next48 = add i64 %lsr.iv47, -1
  %lsr.iv.next51 = add i64 %lsr.iv50, 16
  %exitcond96.not.us26.us = icmp eq i64 %lsr.iv.next48, 0
  br i1 %exitcond96.not.us26.us, label %common.ret, label %B136.us2.us

B136.us2:
  %.280.us3 = phi i64 [ %.336.us21, %B36.prol.loopexit.i.loopexit.us ], [ %.280.pre, %B136.us2.preheader ]
  %K.2.092.us4 = phi ptr [ %.343.us25, %B36.prol.loopexit.i.loopexit.us ], [ %12, %B136.us2.preheader ]
  %.2468890.us5 = phi i64 [ %.253.us20, %B36.prol.loopexit.i.loopexit.us ], [ 0, %B136.us2.preheader ]
  %.281.us6 = inttoptr i64 %.280.us3 to ptr
  %.282.us7 = shl nuw nsw i64 %.2468890.us5, 1
  %.283.us8 = getelementptr i64, ptr %.281.us6, i64 %.282.us7
  %.284.us9 = load i64, ptr %.283.us8, align 8
  %.287.us10 = load i64, ptr %sunkaddr116, align 8
  %.288.us11 = inttoptr i64 %.287.us10 to ptr
  %.291.us12 = load i64, ptr %sunkaddr117, align 8
  %.292.us13 = inttoptr i64 %.291.us12 to ptr
  %.294.us14 = inttoptr i64 %.284.us9 to ptr
  tail call void %.294.us14(ptr %K.2.092.us4, ptr %.288.us11, ptr %.292.us13)
  %.299.us15 = load i64, ptr %sunkaddr124, align 8
  %.303.us17 = load i64, ptr %sunkaddr117, align 8
  %13 = inttoptr i64 %.303.us17 to ptr
  %14 = inttoptr i64 %.299.us15 to ptr
  br label %B36.prol.i.us

B36.prol.i.us:
  %.1043941.prol.i.us = phi i64 [ %.111.prol.i.us, %B36.prol.i.us ], [ 0, %B136.us2 ]
  %.111.prol.i.us = add nuw nsw i64 %.1043941.prol.i.us, 1
  %15 = shl nuw nsw i64 %.1043941.prol.i.us, 3
  %scevgep55 = getelementptr i8, ptr %14, i64 %15
  %.138.prol.i.us = load double, ptr %scevgep55, align 8, !noalias !0
  %scevgep54 = getelementptr i8, ptr %13, i64 %15
  %.141.prol.i.us = load double, ptr %scevgep54, align 8, !noalias !0
  %.144.prol.i.us = fadd double %.138.prol.i.us, %.141.prol.i.us
  store double %.144.prol.i.us, ptr %scevgep55, align 8, !noalias !0
  %prol.iter.cmp.not.i.us = icmp eq i64 %xtraiter.i, %.111.prol.i.us
  br i1 %prol.iter.cmp.not.i.us, label %B36.prol.loopexit.i.loopexit.us, label %B36.prol.i.us, !llvm.loop !3

B36.prol.loopexit.i.loopexit.us:
  %.253.us20 = add nuw nsw i64 %.2468890.us5, 1
  %.336.us21 = load i64, ptr %.279, align 8
  %.337.us22 = inttoptr i64 %.336.us21 to ptr
  %16 = getelementptr i64, ptr %.337.us22, i64 %.282.us7
  %.340.us23 = getelementptr i8, ptr %16, i64 8
  %.341.us24 = load i64, ptr %.340.us23, align 8
  %.343.us25 = getelementptr double, ptr %K.2.092.us4, i64 %.341.us24
  %exitcond96.not.us26 = icmp eq i64 %.253.us20, %.160
  br i1 %exitcond96.not.us26, label %common.ret, label %B136.us2

B136.endif.loopexit:
  %.253 = add nuw nsw i64 %.2468890, 1
  %.336 = load i64, ptr %.279, align 8
  %.337 = inttoptr i64 %.336 to ptr
  %17 = getelementptr i64, ptr %.337, i64 %.282
  %.340 = getelementptr i8, ptr %17, i64 8
  %.341 = load i64, ptr %.340, align 8
  %.343 = getelementptr double, ptr %K.2.092, i64 %.341
  %exitcond96.not = icmp eq i64 %.253, %.160
  br i1 %exitcond96.not, label %common.ret, label %B136
}


define ptr @load_of(ptr readonly %.1) local_unnamed_addr #0 {
entry:
  %.3 = alloca ptr, align 8
  store ptr null, ptr %.3, align 8
  %.7 = call i32 @_ZN18biped_adrc_kernels7load_ofB2v1B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3, ptr nonnull poison, ptr %.1) #0
  %.17 = load ptr, ptr %.3, align 8
  ret ptr %.17
}


define void @numba_gil_ensure(ptr readnone %0) local_unnamed_addr #1 {
  tail call void @llvm.trap()
  unreachable
}


define noalias nonnull ptr @PyUnicode_FromString(ptr readnone %0) local_unnamed_addr #1 {
  tail call void @llvm.trap()
  unreachable
}


define void @PyErr_WriteUnraisable(ptr readnone %0) local_unnamed_addr #1 {
  tail call void @llvm.trap()
  unreachable
}


define void @Py_DecRef(ptr readnone %0) local_unnamed_addr #1 {
  tail call void @llvm.trap()
  unreachable
}


define void @numba_gil_release(ptr readnone %0) local_unnamed_addr #1 {
  tail call void @llvm.trap()
  unreachable
}


define void @PyErr_Clear() local_unnamed_addr #1 {
  tail call void @llvm.trap()
  unreachable
}


define void @PyErr_SetString(ptr readnone %0, ptr readnone %1) local_unnamed_addr #1 {
  tail call void @llvm.trap()
  unreachable
}


define void @PyErr_SetNone(ptr readnone %0) local_unnamed_addr #1 {
  tail call void @llvm.trap()
  unreachable
}

define i32 @_ZN18biped_adrc_kernels4flowB2v3B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2a10float64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r, double %arg.t, ptr readonly %arg.x, ptr %arg.dx) local_unnamed_addr {
B0:
  %.3.i = alloca ptr, align 8
  %.36 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.86 = alloca ptr, align 8
  %excinfo.2 = alloca ptr, align 8
  %.186 = alloca ptr, align 8
  %excinfo.5 = alloca ptr, align 8
  %.17 = getelementptr i8, ptr %arg.r, i64 80
  %.18 = load i64, ptr %.17, align 8
  %.20 = getelementptr i8, ptr %arg.r, i64 640
  %.21 = load i64, ptr %.20, align 8
  %.22 = inttoptr i64 %.21 to ptr
  %.24 = getelementptr i8, ptr %arg.r, i64 96
  %.25 = load i64, ptr %.24, align 8
  %.34 = getelementptr i8, ptr %.22, i64 24
  %.40 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.36, ptr nonnull %excinfo.1, ptr %arg.x, ptr %.34, i64 %.25)
  switch i32 %.40, label %common.ret [
    i32 -2, label %B0.endif
    i32 0, label %B0.endif
  ], !prof !8

B120:
  %.67 = getelementptr i8, ptr %arg.r, i64 88
  %.68 = load i64, ptr %.67, align 8
  %.70 = sub nsw i64 %.18, %.68
  %.72 = getelementptr double, ptr %arg.x, i64 %.70
  %.76 = add nsw i64 %.18, 3
  %.80 = sub i64 %.76, %.68
  %.82 = getelementptr double, ptr %.22, i64 %.80
  %.90 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.86, ptr nonnull %excinfo.2, ptr %.72, ptr %.82, i64 %.68)
  switch i32 %.90, label %common.ret [
    i32 -2, label %B258.endif
    i32 0, label %B258.endif
  ], !prof !8

B0.endif:
  %.63 = icmp slt i64 %.25, %.18
  br i1 %.63, label %B120, label %B258.endif

common.ret:
  %retptr.sink = phi ptr [ %excinfo, %B258.endif.endif ], [ %excinfo, %B120 ], [ %excinfo, %B0 ], [ %retptr, %B16.i ], [ %retptr, %B258.endif.endif.endif ]
  %common.ret.op = phi i32 [ %.190, %B258.endif.endif ], [ %.90, %B120 ], [ %.40, %B0 ], [ 0, %B16.i ], [ 0, %B258.endif.endif.endif ]
  store ptr null, ptr %retptr.sink, align 8
  ret i32 %common.ret.op

B258.endif:
  %.115 = getelementptr i8, ptr %arg.r, i64 512
  %.117 = load double, ptr %.115, align 8
  %.12.i = fcmp olt double %.117, %arg.t
  %.13.i = select i1 %.12.i, double %.117, double %arg.t
  %.6.i.i = getelementptr i8, ptr %arg.r, i64 352
  %.8.i.i = load double, ptr %.6.i.i, align 8, !noalias !9
  %.9.i.i = getelementptr i8, ptr %arg.r, i64 360
  %.11.i.i = load double, ptr %.9.i.i, align 8, !noalias !9
  %.13.i.i = load i64, ptr %.20, align 8, !noalias !9
  %.14.i.i = inttoptr i64 %.13.i.i to ptr
  store double %.13.i, ptr %.14.i.i, align 8, !noalias !9
  %.18.i.i = load i64, ptr %.20, align 8, !noalias !9
  %.19.i.i = inttoptr i64 %.18.i.i to ptr
  %.20.i.i = getelementptr i8, ptr %.19.i.i, i64 8
  store double %.8.i.i, ptr %.20.i.i, align 8, !noalias !9
  %.23.i.i = load i64, ptr %.20, align 8, !noalias !9
  %.24.i.i = inttoptr i64 %.23.i.i to ptr
  %.25.i.i = getelementptr i8, ptr %.24.i.i, i64 16
  store double %.11.i.i, ptr %.25.i.i, align 8, !noalias !9
  %.37.i = getelementptr i8, ptr %arg.r, i64 200
  %.38.i = load i64, ptr %.37.i, align 8, !noalias !14
  %.39.i = icmp sgt i64 %.38.i, 0
  br i1 %.39.i, label %B58.i, label %B258.endif.endif

B58.i:
  %.7.i = call i32 @_ZN18biped_adrc_kernels7load_ofB2v1B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3.i, ptr nonnull poison, ptr nonnull readonly %arg.r) #0, !noalias !14
  br label %B258.endif.endif

B258.endif.endif:
  %.176 = getelementptr i8, ptr %arg.r, i64 656
  %.177 = load i64, ptr %.176, align 8
  %.178 = inttoptr i64 %.177 to ptr
  %0 = getelementptr double, ptr %.22, i64 %.18
  %.182 = getelementptr i8, ptr %0, i64 24
  %.184 = getelementptr i8, ptr %arg.r, i64 72
  %.185 = load i64, ptr %.184, align 8
  %.190 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.186, ptr nonnull %excinfo.5, ptr %.178, ptr %.182, i64 %.185)
  switch i32 %.190, label %common.ret [
    i32 -2, label %B258.endif.endif.endif
    i32 0, label %B258.endif.endif.endif
  ], !prof !8

B258.endif.endif.endif:
  %.212 = load i64, ptr %arg.r, align 8
  %.214 = getelementptr i8, ptr %arg.r, i64 272
  %.215 = load i64, ptr %.214, align 8
  %.216 = inttoptr i64 %.215 to ptr
  %.219 = inttoptr i64 %.212 to ptr
  tail call void %.219(ptr %.216, ptr %.22, ptr %arg.dx)
  %.226 = getelementptr double, ptr %arg.dx, i64 %.18
  %.227 = load double, ptr %.226, align 8
  %.14.i = fcmp ugt double %.227, 0.000000e+00
  br i1 %.14.i, label %common.ret, label %B16.i

B16.i:
  %.17.i = fcmp oeq double %.227, 0.000000e+00
  %"$phi54.0.2.0.i" = select i1 %.17.i, i64 5, i64 8
  %.30.i = getelementptr i8, ptr %arg.r, i64 496
  store i64 %"$phi54.0.2.0.i", ptr %.30.i, align 8, !noalias !15
  store double 0x7FF8000000000000, ptr %arg.dx, align 8, !noalias !15
  br label %common.ret
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.x, ptr writeonly %arg.out, i64 %arg.size) local_unnamed_addr #0 {
B0.endif:
  %.9240.not = icmp slt i64 %arg.size, 1
  br i1 %.9240.not, label %B62, label %iter.check

iter.check:
  %arg.out1 = ptrtoint ptr %arg.out to i64
  %arg.x2 = ptrtoint ptr %arg.x to i64
  %min.iters.check = icmp samesign ult i64 %arg.size, 4
  %0 = sub i64 %arg.out1, %arg.x2
  %diff.check = icmp ult i64 %0, 128
  %or.cond = select i1 %min.iters.check, i1 true, i1 %diff.check
  br i1 %or.cond, label %B36.preheader, label %vector.main.loop.iter.check

vector.main.loop.iter.check:
  %min.iters.check3 = icmp samesign ult i64 %arg.size, 16
  br i1 %min.iters.check3, label %vec.epilog.ph, label %vector.ph

vector.ph:
  %n.vec = and i64 %arg.size, 9223372036854775792
  br label %vector.body

vector.body:
  %index = phi i64 [ 0, %vector.ph ], [ %index.next, %vector.body ]
  %sunkaddr59 = shl i64 %index, 3
  %sunkaddr60 = getelementptr i8, ptr %arg.x, i64 %sunkaddr59
  %wide.load = load <4 x double>, ptr %sunkaddr60, align 8
  %sunkaddr63 = getelementptr i8, ptr %sunkaddr60, i64 32
  %wide.load4 = load <4 x double>, ptr %sunkaddr63, align 8
  %sunkaddr66 = getelementptr i8, ptr %sunkaddr60, i64 64
  %wide.load5 = load <4 x double>, ptr %sunkaddr66, align 8
  %sunkaddr68 = getelementptr i8, ptr %sunkaddr60, i64 96
  %wide.load6 = load <4 x double>, ptr %sunkaddr68, align 8
  %sunkaddr70 = getelementptr i8, ptr %arg.out, i64 %sunkaddr59
  store <4 x double> %wide.load, ptr %sunkaddr70, align 8
  %sunkaddr73 = getelementptr i8, ptr %sunkaddr70, i64 32
  store <4 x double> %wide.load4, ptr %sunkaddr73, align 8
  %sunkaddr76 = getelementptr i8, ptr %sunkaddr70, i64 64
  store <4 x double> %wide.load5, ptr %sunkaddr76, align 8
  %sunkaddr79 = getelementptr i8, ptr %sunkaddr70, i64 96
  store <4 x double> %wide.load6, ptr %sunkaddr79, align 8
  %index.next = add nuw nsw i64 %index, 16
  %1 = icmp eq i64 %n.vec, %index.next
  br i1 %1, label %middle.block, label %vector.body, !llvm.loop !18

middle.block:
  %cmp.n = icmp eq i64 %arg.size, %n.vec
  br i1 %cmp.n, label %B62, label %vec.epilog.iter.check

vec.epilog.iter.check:
  %2 = and i64 %arg.size, 12
  %min.epilog.iters.check = icmp eq i64 %2, 0
  br i1 %min.epilog.iters.check, label %B36.preheader, label %vec.epilog.ph, !prof !20

vec.epilog.ph:
  %vec.epilog.resume.val = phi i64 [ %n.vec, %vec.epilog.iter.check ], [ 0, %vector.main.loop.iter.check ]
  %n.vec8 = and i64 %arg.size, 9223372036854775804
  br label %vec.epilog.vector.body

vec.epilog.vector.body:
  %index9 = phi i64 [ %vec.epilog.resume.val, %vec.epilog.ph ], [ %index.next11, %vec.epilog.vector.body ]
  %3 = shl i64 %index9, 3
  %scevgep48 = getelementptr i8, ptr %arg.x, i64 %3
  %wide.load10 = load <4 x double>, ptr %scevgep48, align 8
  %scevgep47 = getelementptr i8, ptr %arg.out, i64 %3
  store <4 x double> %wide.load10, ptr %scevgep47, align 8
  %index.next11 = add nuw i64 %index9, 4
  %4 = icmp eq i64 %n.vec8, %index.next11
  br i1 %4, label %vec.epilog.middle.block, label %vec.epilog.vector.body, !llvm.loop !21

vec.epilog.middle.block:
  %cmp.n12 = icmp eq i64 %arg.size, %n.vec8
  br i1 %cmp.n12, label %B62, label %B36.preheader

B36.preheader:
  %.983941.ph = phi i64 [ 0, %iter.check ], [ %n.vec, %vec.epilog.iter.check ], [ %n.vec8, %vec.epilog.middle.block ]
  %5 = sub nsw i64 %arg.size, %.983941.ph
  %xtraiter = and i64 %5, 7
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B36.prol.loopexit, label %B36.prol

B36.prol:
  %lsr.iv = phi i64 [ %lsr.iv.next, %B36.prol ], [ %xtraiter, %B36.preheader ]
  %.983941.prol = phi i64 [ %.105.prol, %B36.prol ], [ %.983941.ph, %B36.preheader ]
  %.105.prol = add nuw i64 %.983941.prol, 1
  %6 = shl i64 %.983941.prol, 3
  %scevgep46 = getelementptr i8, ptr %arg.x, i64 %6
  %.132.prol = load double, ptr %scevgep46, align 8
  %scevgep45 = getelementptr i8, ptr %arg.out, i64 %6
  store double %.132.prol, ptr %scevgep45, align 8
  %lsr.iv.next = add nsw i64 %lsr.iv, -1
  %prol.iter.cmp.not = icmp eq i64 %lsr.iv.next, 0
  br i1 %prol.iter.cmp.not, label %B36.prol.loopexit, label %B36.prol, !llvm.loop !22

B36.prol.loopexit:
  %.983941.unr = phi i64 [ %.983941.ph, %B36.preheader ], [ %.105.prol, %B36.prol ]
  %7 = sub nsw i64 %.983941.ph, %arg.size
  %8 = icmp ugt i64 %7, -8
  br i1 %8, label %B62, label %B36

B36:
  %.983941 = phi i64 [ %.105.7, %B36 ], [ %.983941.unr, %B36.prol.loopexit ]
  %sunkaddr80 = shl i64 %.983941, 3
  %sunkaddr81 = getelementptr i8, ptr %arg.x, i64 %sunkaddr80
  %.132 = load double, ptr %sunkaddr81, align 8
  %sunkaddr83 = getelementptr i8, ptr %arg.out, i64 %sunkaddr80
  store double %.132, ptr %sunkaddr83, align 8
  %sunkaddr86 = getelementptr i8, ptr %sunkaddr81, i64 8
  %.132.1 = load double, ptr %sunkaddr86, align 8
  %sunkaddr89 = getelementptr i8, ptr %sunkaddr83, i64 8
  store double %.132.1, ptr %sunkaddr89, align 8
  %sunkaddr92 = getelementptr i8, ptr %sunkaddr81, i64 16
  %.132.2 = load double, ptr %sunkaddr92, align 8
  %sunkaddr95 = getelementptr i8, ptr %sunkaddr83, i64 16
  store double %.132.2, ptr %sunkaddr95, align 8
  %sunkaddr98 = getelementptr i8, ptr %sunkaddr81, i64 24
  %.132.3 = load double, ptr %sunkaddr98, align 8
  %sunkaddr101 = getelementptr i8, ptr %sunkaddr83, i64 24
  store double %.132.3, ptr %sunkaddr101, align 8
  %sunkaddr104 = getelementptr i8, ptr %sunkaddr81, i64 32
  %.132.4 = load double, ptr %sunkaddr104, align 8
  %sunkaddr107 = getelementptr i8, ptr %sunkaddr83, i64 32
  store double %.132.4, ptr %sunkaddr107, align 8
  %sunkaddr110 = getelementptr i8, ptr %sunkaddr81, i64 40
  %.132.5 = load double, ptr %sunkaddr110, align 8
  %sunkaddr113 = getelementptr i8, ptr %sunkaddr83, i64 40
  store double %.132.5, ptr %sunkaddr113, align 8
  %sunkaddr116 = getelementptr i8, ptr %sunkaddr81, i64 48
  %.132.6 = load double, ptr %sunkaddr116, align 8
  %sunkaddr119 = getelementptr i8, ptr %sunkaddr83, i64 48
  store double %.132.6, ptr %sunkaddr119, align 8
  %.105.7 = add nuw nsw i64 %.983941, 8
  %sunkaddr122 = getelementptr i8, ptr %sunkaddr81, i64 56
  %.132.7 = load double, ptr %sunkaddr122, align 8
  %sunkaddr125 = getelementptr i8, ptr %sunkaddr83, i64 56
  store double %.132.7, ptr %sunkaddr125, align 8
  %exitcond.not.7 = icmp eq i64 %arg.size, %.105.7
  br i1 %exitcond.not.7, label %B62, label %B36, !llvm.loop !23

B62:
  store ptr null, ptr %retptr, align 8
  ret i32 0
}


define ptr @flow(ptr %.1, double %.2, ptr readonly %.3, ptr %.4) local_unnamed_addr #0 {
entry:
  %.6 = alloca ptr, align 8
  store ptr null, ptr %.6, align 8
  %excinfo = alloca ptr, align 8
  %.10 = call i32 @_ZN18biped_adrc_kernels4flowB2v3B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2a10float64_2a(ptr nonnull %.6, ptr nonnull %excinfo, ptr %.1, double %.2, ptr %.3, ptr %.4) #0
  %cond = icmp eq i32 %.10, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.20 = load ptr, ptr %.6, align 8
  ret ptr %.20
}


define noalias nonnull ptr @PyBytes_FromStringAndSize(ptr readnone %0, i64 %1) local_unnamed_addr #1 {
  tail call void @llvm.trap()
  unreachable
}


define noalias nonnull ptr @numba_unpickle(ptr readnone %0, i32 %1, ptr readnone %2) local_unnamed_addr #1 {
  tail call void @llvm.trap()
  unreachable
}


define noalias nonnull ptr @numba_runtime_build_excinfo_struct(ptr readnone %0, ptr readnone %1) local_unnamed_addr #1 {
  tail call void @llvm.trap()
  unreachable
}


define void @NRT_Free(ptr readnone %0) local_unnamed_addr #1 {
  tail call void @llvm.trap()
  unreachable
}


define void @numba_do_raise(ptr readnone %0) local_unnamed_addr #1 {
  tail call void @llvm.trap()
  unreachable
}

define i32 @_ZN18biped_adrc_kernels9remainderB2v9B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2a10float64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r, double %arg.t, ptr %arg.y, ptr %arg.N) local_unnamed_addr {
B0:
  %.3.i = alloca ptr, align 8
  %.53 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.148 = alloca ptr, align 8
  %excinfo.4 = alloca ptr, align 8
  %.188 = alloca ptr, align 8
  %excinfo.5 = alloca ptr, align 8
  %.17 = getelementptr i8, ptr %arg.r, i64 640
  %.18 = load i64, ptr %.17, align 8
  %.24 = getelementptr i8, ptr %arg.r, i64 200
  %.25 = load i64, ptr %.24, align 8
  %.26 = icmp sgt i64 %.25, 0
  br i1 %.26, label %B40, label %B194.endif

B40:
  %0 = inttoptr i64 %.18 to ptr
  %.29 = getelementptr i8, ptr %arg.r, i64 40
  %.30 = load i64, ptr %.29, align 8
  %.32 = getelementptr i8, ptr %arg.r, i64 272
  %.33 = load i64, ptr %.32, align 8
  %.34 = inttoptr i64 %.33 to ptr
  %.36 = getelementptr i8, ptr %arg.r, i64 648
  %.37 = load i64, ptr %.36, align 8
  %.38 = inttoptr i64 %.37 to ptr
  %.40 = inttoptr i64 %.30 to ptr
  tail call void %.40(ptr %.34, ptr %arg.y, ptr %.38)
  %.45 = load i64, ptr %.36, align 8
  %.46 = inttoptr i64 %.45 to ptr
  %.48 = getelementptr i8, ptr %0, i64 24
  %.50 = getelementptr i8, ptr %arg.r, i64 72
  %.51 = load i64, ptr %.50, align 8
  %.52 = shl nsw i64 %.51, 1
  %.57 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.53, ptr nonnull %excinfo.1, ptr %.46, ptr %.48, i64 %.52)
  switch i32 %.57, label %common.ret [
    i32 -2, label %B194.endif
    i32 0, label %B194.endif
  ], !prof !8

common.ret:
  %retptr.sink = phi ptr [ %excinfo, %B194.endif.endif.endif ], [ %excinfo, %B194.endif.endif ], [ %excinfo, %B40 ], [ %retptr, %B16.i ], [ %retptr, %B194.endif.endif.endif.endif ]
  %common.ret.op = phi i32 [ %.192, %B194.endif.endif.endif ], [ %.152, %B194.endif.endif ], [ %.57, %B40 ], [ 0, %B16.i ], [ 0, %B194.endif.endif.endif.endif ]
  store ptr null, ptr %retptr.sink, align 8
  ret i32 %common.ret.op

B194.endif:
  %.82 = getelementptr i8, ptr %arg.r, i64 512
  %.84 = load double, ptr %.82, align 8
  %.12.i = fcmp olt double %.84, %arg.t
  %.13.i = select i1 %.12.i, double %.84, double %arg.t
  %.6.i.i = getelementptr i8, ptr %arg.r, i64 352
  %.8.i.i = load double, ptr %.6.i.i, align 8, !noalias !25
  %.9.i.i = getelementptr i8, ptr %arg.r, i64 360
  %.11.i.i = load double, ptr %.9.i.i, align 8, !noalias !25
  %.13.i.i = load i64, ptr %.17, align 8, !noalias !25
  %.14.i.i = inttoptr i64 %.13.i.i to ptr
  store double %.13.i, ptr %.14.i.i, align 8, !noalias !25
  %.18.i.i = load i64, ptr %.17, align 8, !noalias !25
  %.19.i.i = inttoptr i64 %.18.i.i to ptr
  %.20.i.i = getelementptr i8, ptr %.19.i.i, i64 8
  store double %.8.i.i, ptr %.20.i.i, align 8, !noalias !25
  %.23.i.i = load i64, ptr %.17, align 8, !noalias !25
  %.24.i.i = inttoptr i64 %.23.i.i to ptr
  %.25.i.i = getelementptr i8, ptr %.24.i.i, i64 16
  store double %.11.i.i, ptr %.25.i.i, align 8, !noalias !25
  %.38.i = load i64, ptr %.24, align 8, !noalias !30
  %.39.i = icmp sgt i64 %.38.i, 0
  br i1 %.39.i, label %B58.i, label %B194.endif.endif

B58.i:
  %.7.i = call i32 @_ZN18biped_adrc_kernels7load_ofB2v1B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3.i, ptr nonnull poison, ptr nonnull readonly %arg.r) #0, !noalias !30
  br label %B194.endif.endif

B194.endif.endif:
  %1 = inttoptr i64 %.18 to ptr
  %.143 = getelementptr i8, ptr %1, i64 24
  %.145 = getelementptr i8, ptr %arg.r, i64 80
  %.146 = load i64, ptr %.145, align 8
  %.152 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.148, ptr nonnull %excinfo.4, ptr %arg.y, ptr %.143, i64 %.146)
  switch i32 %.152, label %common.ret [
    i32 -2, label %B194.endif.endif.endif
    i32 0, label %B194.endif.endif.endif
  ], !prof !8

B194.endif.endif.endif:
  %.176 = getelementptr i8, ptr %arg.r, i64 656
  %.177 = load i64, ptr %.176, align 8
  %.178 = inttoptr i64 %.177 to ptr
  %.181 = load i64, ptr %.145, align 8
  %2 = getelementptr double, ptr %1, i64 %.181
  %.184 = getelementptr i8, ptr %2, i64 24
  %.186 = getelementptr i8, ptr %arg.r, i64 72
  %.187 = load i64, ptr %.186, align 8
  %.192 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.188, ptr nonnull %excinfo.5, ptr %.178, ptr %.184, i64 %.187)
  switch i32 %.192, label %common.ret [
    i32 -2, label %B194.endif.endif.endif.endif
    i32 0, label %B194.endif.endif.endif.endif
  ], !prof !8

B194.endif.endif.endif.endif:
  %.213 = getelementptr i8, ptr %arg.r, i64 48
  %.214 = load i64, ptr %.213, align 8
  %.216 = getelementptr i8, ptr %arg.r, i64 272
  %.217 = load i64, ptr %.216, align 8
  %.218 = inttoptr i64 %.217 to ptr
  %.221 = inttoptr i64 %.214 to ptr
  tail call void %.221(ptr %.218, ptr %1, ptr %arg.N)
  %.227 = getelementptr i8, ptr %arg.r, i64 120
  %.228 = load i64, ptr %.227, align 8
  %.230 = getelementptr double, ptr %arg.N, i64 %.228
  %.231 = load double, ptr %.230, align 8
  %.14.i = fcmp ugt double %.231, 0.000000e+00
  br i1 %.14.i, label %common.ret, label %B16.i

B16.i:
  %.17.i = fcmp oeq double %.231, 0.000000e+00
  %"$phi54.0.2.0.i" = select i1 %.17.i, i64 5, i64 8
  %.30.i = getelementptr i8, ptr %arg.r, i64 496
  store i64 %"$phi54.0.2.0.i", ptr %.30.i, align 8, !noalias !31
  store double 0x7FF8000000000000, ptr %arg.N, align 8, !noalias !31
  br label %common.ret
}


define ptr @remainder(ptr %.1, double %.2, ptr %.3, ptr %.4) local_unnamed_addr #0 {
entry:
  %.6 = alloca ptr, align 8
  store ptr null, ptr %.6, align 8
  %excinfo = alloca ptr, align 8
  %.10 = call i32 @_ZN18biped_adrc_kernels9remainderB2v9B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2a10float64_2a(ptr nonnull %.6, ptr nonnull %excinfo, ptr %.1, double %.2, ptr %.3, ptr %.4) #0
  %cond = icmp eq i32 %.10, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.20 = load ptr, ptr %.6, align 8
  ret ptr %.20
}

define i32 @_ZN18biped_adrc_kernels5watchB3v10B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2a10float64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr readonly %arg.r, double %arg.t, ptr readonly %arg.q, ptr %arg.out) local_unnamed_addr {
B0:
  %.36 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.8 = getelementptr i8, ptr %arg.r, i64 360
  %.10 = load double, ptr %.8, align 8
  %.11 = getelementptr i8, ptr %arg.r, i64 504
  %.13 = load double, ptr %.11, align 8
  %.14 = getelementptr i8, ptr %arg.r, i64 640
  %.15 = load i64, ptr %.14, align 8
  %.16 = inttoptr i64 %.15 to ptr
  store double %arg.t, ptr %.16, align 8
  %.20 = load i64, ptr %.14, align 8
  %.21 = inttoptr i64 %.20 to ptr
  %.22 = getelementptr i8, ptr %.21, i64 8
  store double %.10, ptr %.22, align 8
  %.25 = load i64, ptr %.14, align 8
  %.26 = inttoptr i64 %.25 to ptr
  %.27 = getelementptr i8, ptr %.26, i64 16
  store double %.13, ptr %.27, align 8
  %.31 = load i64, ptr %.14, align 8
  %.32 = inttoptr i64 %.31 to ptr
  %.33 = getelementptr i8, ptr %.32, i64 24
  %.34 = getelementptr i8, ptr %arg.r, i64 72
  %.35 = load i64, ptr %.34, align 8
  %.40 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.36, ptr nonnull %excinfo.1, ptr %arg.q, ptr %.33, i64 %.35)
  switch i32 %.40, label %common.ret [
    i32 -2, label %B0.endif
    i32 0, label %B0.endif
  ], !prof !8

common.ret:
  %excinfo.sink = phi ptr [ %retptr, %B0.endif ], [ %excinfo, %B0 ]
  %common.ret.op = phi i32 [ 0, %B0.endif ], [ %.40, %B0 ]
  store ptr null, ptr %excinfo.sink, align 8
  ret i32 %common.ret.op

B0.endif:
  %.62 = getelementptr i8, ptr %arg.r, i64 24
  %.63 = load i64, ptr %.62, align 8
  %.64 = getelementptr i8, ptr %arg.r, i64 272
  %.65 = load i64, ptr %.64, align 8
  %.66 = inttoptr i64 %.65 to ptr
  %.68 = load i64, ptr %.14, align 8
  %.69 = inttoptr i64 %.68 to ptr
  %.70 = inttoptr i64 %.63 to ptr
  tail call void %.70(ptr %.66, ptr %.69, ptr %arg.out)
  br label %common.ret
}


define ptr @watch(ptr readonly %.1, double %.2, ptr readonly %.3, ptr %.4) local_unnamed_addr #0 {
entry:
  %.6 = alloca ptr, align 8
  store ptr null, ptr %.6, align 8
  %excinfo = alloca ptr, align 8
  %.10 = call i32 @_ZN18biped_adrc_kernels5watchB3v10B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2a10float64_2a(ptr nonnull %.6, ptr nonnull %excinfo, ptr %.1, double %.2, ptr %.3, ptr %.4) #0
  %cond = icmp eq i32 %.10, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.20 = load ptr, ptr %.6, align 8
  ret ptr %.20
}

define i32 @_ZN18biped_adrc_kernels4nodeB3v11B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2a10float64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r, double %arg.t, ptr readonly %arg.x, ptr readonly %arg.dx) local_unnamed_addr {
B0:
  %.3.i = alloca ptr, align 8
  %.53 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.90 = alloca ptr, align 8
  %excinfo.2 = alloca ptr, align 8
  %.129 = alloca ptr, align 8
  %excinfo.3 = alloca ptr, align 8
  %.17 = getelementptr i8, ptr %arg.r, i64 80
  %.18 = load i64, ptr %.17, align 8
  %.20 = getelementptr i8, ptr %arg.r, i64 560
  %.21 = load i64, ptr %.20, align 8
  %.22 = inttoptr i64 %.21 to ptr
  %.24 = getelementptr i8, ptr %arg.r, i64 408
  %.25 = load i64, ptr %.24, align 8
  %.27 = getelementptr i8, ptr %arg.r, i64 456
  %.28 = load i64, ptr %.27, align 8
  %.29 = mul nsw i64 %.28, %.25
  %.30 = getelementptr double, ptr %.22, i64 %.29
  store double %arg.t, ptr %.30, align 8
  %.42 = getelementptr i8, ptr %arg.r, i64 64
  %.43 = load i64, ptr %.42, align 8
  %.44 = icmp eq i64 %.43, 0
  br i1 %.44, label %B118, label %B250

B118:
  %.50 = getelementptr i8, ptr %.30, i64 8
  %.57 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.53, ptr nonnull %excinfo.1, ptr %arg.x, ptr %.50, i64 %.18)
  switch i32 %.57, label %common.ret [
    i32 -2, label %B118.endif
    i32 0, label %B118.endif
  ], !prof !8

B250:
  %.123 = getelementptr i8, ptr %arg.r, i64 640
  %.124 = load i64, ptr %.123, align 8
  %.125 = inttoptr i64 %.124 to ptr
  %.126 = getelementptr i8, ptr %.125, i64 24
  %.133 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.129, ptr nonnull %excinfo.3, ptr %arg.x, ptr %.126, i64 %.18)
  switch i32 %.133, label %common.ret [
    i32 -2, label %B250.endif
    i32 0, label %B250.endif
  ], !prof !8

B118.endif:
  %0 = getelementptr double, ptr %.30, i64 %.18
  %.85 = getelementptr i8, ptr %0, i64 8
  %.94 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.90, ptr nonnull %excinfo.2, ptr %arg.dx, ptr %.85, i64 %.18)
  switch i32 %.94, label %common.ret [
    i32 -2, label %B652.endif
    i32 0, label %B652.endif
  ], !prof !8

common.ret:
  %retptr.sink = phi ptr [ %retptr, %B652.endif ], [ %excinfo, %B118.endif ], [ %excinfo, %B118 ], [ %excinfo, %B250 ]
  %common.ret.op = phi i32 [ 0, %B652.endif ], [ %.94, %B118.endif ], [ %.57, %B118 ], [ %.133, %B250 ]
  store ptr null, ptr %retptr.sink, align 8
  ret i32 %common.ret.op

B250.endif:
  %.158 = getelementptr i8, ptr %arg.r, i64 208
  %.159 = load i64, ptr %.158, align 8
  %.160.not = icmp eq i64 %.159, 0
  br i1 %.160.not, label %B414.endif, label %B344.endif

B344.endif:
  %.164 = getelementptr i8, ptr %arg.r, i64 512
  %.166 = load double, ptr %.164, align 8
  %.12.i = fcmp olt double %.166, %arg.t
  %.13.i = select i1 %.12.i, double %.166, double %arg.t
  %.6.i.i = getelementptr i8, ptr %arg.r, i64 352
  %.8.i.i = load double, ptr %.6.i.i, align 8, !noalias !34
  %.9.i.i = getelementptr i8, ptr %arg.r, i64 360
  %.11.i.i = load double, ptr %.9.i.i, align 8, !noalias !34
  %.13.i.i = load i64, ptr %.123, align 8, !noalias !34
  %.14.i.i = inttoptr i64 %.13.i.i to ptr
  store double %.13.i, ptr %.14.i.i, align 8, !noalias !34
  %.18.i.i = load i64, ptr %.123, align 8, !noalias !34
  %.19.i.i = inttoptr i64 %.18.i.i to ptr
  %.20.i.i = getelementptr i8, ptr %.19.i.i, i64 8
  store double %.8.i.i, ptr %.20.i.i, align 8, !noalias !34
  %.23.i.i = load i64, ptr %.123, align 8, !noalias !34
  %.24.i.i = inttoptr i64 %.23.i.i to ptr
  %.25.i.i = getelementptr i8, ptr %.24.i.i, i64 16
  store double %.11.i.i, ptr %.25.i.i, align 8, !noalias !34
  %.37.i = getelementptr i8, ptr %arg.r, i64 200
  %.38.i = load i64, ptr %.37.i, align 8, !noalias !39
  %.39.i = icmp sgt i64 %.38.i, 0
  br i1 %.39.i, label %B58.i, label %B414.endif

B58.i:
  %.7.i = call i32 @_ZN18biped_adrc_kernels7load_ofB2v1B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3.i, ptr nonnull poison, ptr nonnull readonly %arg.r) #0, !noalias !39
  br label %B414.endif

B414.endif:
  %.6.i = getelementptr i8, ptr %arg.r, i64 352
  %.8.i = load double, ptr %.6.i, align 8, !noalias !40
  %.9.i = getelementptr i8, ptr %arg.r, i64 360
  %.11.i = load double, ptr %.9.i, align 8, !noalias !40
  %.13.i2 = load i64, ptr %.123, align 8, !noalias !40
  %.14.i = inttoptr i64 %.13.i2 to ptr
  store double %arg.t, ptr %.14.i, align 8, !noalias !40
  %.18.i = load i64, ptr %.123, align 8, !noalias !40
  %.19.i = inttoptr i64 %.18.i to ptr
  %.20.i = getelementptr i8, ptr %.19.i, i64 8
  store double %.8.i, ptr %.20.i, align 8, !noalias !40
  %.23.i = load i64, ptr %.123, align 8, !noalias !40
  %.24.i = inttoptr i64 %.23.i to ptr
  %.25.i = getelementptr i8, ptr %.24.i, i64 16
  store double %.11.i, ptr %.25.i, align 8, !noalias !40
  %.254 = load double, ptr %.6.i, align 8
  %.256 = getelementptr i8, ptr %arg.r, i64 656
  %.257 = load i64, ptr %.256, align 8
  %.258 = inttoptr i64 %.257 to ptr
  %.260 = getelementptr i8, ptr %arg.r, i64 72
  %.261 = load i64, ptr %.260, align 8
  %.262 = getelementptr double, ptr %.258, i64 %.261
  %.263 = load double, ptr %.262, align 8
  %.272 = getelementptr i8, ptr %.262, i64 8
  %.273 = load double, ptr %.272, align 8
  %.275 = getelementptr i8, ptr %.30, i64 8
  store double %.254, ptr %.275, align 8
  %.278 = getelementptr i8, ptr %.30, i64 16
  store double %.263, ptr %.278, align 8
  %.281 = getelementptr i8, ptr %.30, i64 24
  store double %.273, ptr %.281, align 8
  %.285 = load i64, ptr %.42, align 8
  %.287 = getelementptr i8, ptr %arg.r, i64 272
  %.288 = load i64, ptr %.287, align 8
  %.289 = inttoptr i64 %.288 to ptr
  %.292 = load i64, ptr %.123, align 8
  %.293 = inttoptr i64 %.292 to ptr
  %.295 = getelementptr i8, ptr %.30, i64 32
  %.298 = inttoptr i64 %.285 to ptr
  tail call void %.298(ptr %.289, ptr %.293, ptr %.295)
  br label %B652.endif

B652.endif:
  %.303 = load i64, ptr %.24, align 8
  %.304 = add nsw i64 %.303, 1
  %.306 = getelementptr i8, ptr %arg.r, i64 448
  %.307 = load i64, ptr %.306, align 8
  %.308 = add nsw i64 %.307, -1
  %.13.i3 = tail call i64 @llvm.smin.i64(i64 %.308, i64 %.304)
  store i64 %.13.i3, ptr %.24, align 8
  br label %common.ret
}


declare i64 @llvm.smin.i64(i64, i64) #2


define ptr @node(ptr %.1, double %.2, ptr readonly %.3, ptr readonly %.4) local_unnamed_addr #0 {
entry:
  %.6 = alloca ptr, align 8
  store ptr null, ptr %.6, align 8
  %excinfo = alloca ptr, align 8
  %.10 = call i32 @_ZN18biped_adrc_kernels4nodeB3v11B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2a10float64_2a(ptr nonnull %.6, ptr nonnull %excinfo, ptr %.1, double %.2, ptr %.3, ptr %.4) #0
  %cond = icmp eq i32 %.10, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.20 = load ptr, ptr %.6, align 8
  ret ptr %.20
}

define i32 @_ZN18biped_adrc_kernels3dueB3v13B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r) local_unnamed_addr {
B0:
  %.130 = alloca ptr, align 8
  %excinfo.3 = alloca ptr, align 8
  store ptr null, ptr %excinfo.3, align 8
  %.283 = alloca ptr, align 8
  %excinfo.7 = alloca ptr, align 8
  %.313 = alloca ptr, align 8
  %excinfo.8 = alloca ptr, align 8
  %.348 = alloca ptr, align 8
  %excinfo.9 = alloca ptr, align 8
  %.8 = getelementptr i8, ptr %arg.r, i64 72
  %.9 = load i64, ptr %.8, align 8
  %.11 = getelementptr i8, ptr %arg.r, i64 80
  %.12 = load i64, ptr %.11, align 8
  %.14 = getelementptr i8, ptr %arg.r, i64 696
  %.15 = load i64, ptr %.14, align 8
  %.18 = getelementptr i8, ptr %arg.r, i64 648
  %.19 = load i64, ptr %.18, align 8
  %.22 = getelementptr i8, ptr %arg.r, i64 704
  %.23 = load i64, ptr %.22, align 8
  %.51 = getelementptr i8, ptr %arg.r, i64 216
  %.53 = load double, ptr %.51, align 8
  %.54 = fcmp ogt double %.53, 0.000000e+00
  br i1 %.54, label %B104.endif, label %B734

B186:
  %0 = inttoptr i64 %.15 to ptr
  %.134 = call i32 @_ZN18biped_adrc_kernels7measureB3v16B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a(ptr nonnull %.130, ptr nonnull %excinfo.3, ptr nonnull %arg.r, ptr %0)
  %cond = icmp eq i32 %.134, 0
  br i1 %cond, label %B186.endif, label %B186.if.if, !prof !24

B422:
  %.287 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.283, ptr nonnull %excinfo.7, ptr nonnull %22, ptr %0, i64 %.12)
  switch i32 %.287, label %B422.if.if [
    i32 -2, label %B422.endif
    i32 0, label %B422.endif
  ], !prof !8

B668:
  %.503 = getelementptr i8, ptr %arg.r, i64 96
  %.504 = load i64, ptr %.503, align 8
  %.509 = icmp eq i64 %.504, %.373
  %.516 = icmp sgt i64 %.12, %.373
  %or.cond = select i1 %.509, i1 %.516, i1 false
  %"$phi722.0.2.0" = zext i1 %or.cond to i64
  %.533 = getelementptr i8, ptr %arg.r, i64 464
  store i64 %"$phi722.0.2.0", ptr %.533, align 8
  br label %B734

B734:
  %.545 = getelementptr i8, ptr %arg.r, i64 224
  %.547 = load double, ptr %.545, align 8
  %.548 = fcmp ogt double %.547, 0.000000e+00
  br i1 %.548, label %B756.endif, label %B996

B824:
  %.599 = load double, ptr %.51, align 8
  %.7.i = fsub double %.587, %.580
  %.11.i = fdiv double %.7.i, %.599
  %.12.i = fadd double %.11.i, 5.000000e-01
  %.13.i = tail call double @llvm.floor.f64(double %.12.i)
  %.14.i = fptosi double %.13.i to i64
  %.15.i = sitofp i64 %.14.i to double
  %.16.i = fmul double %.599, %.15.i
  %.17.i = fadd double %.580, %.16.i
  %.18.i = fcmp une double %.587, %.17.i
  br i1 %.18.i, label %B996, label %B878.endif

B920:
  %.725129131 = phi i64 [ 0, %B920.preheader.new ], [ %.732.7, %B920 ]
  %.759 = load i64, ptr %.638, align 8
  %1 = mul i64 %.759, -16
  %scevgep99 = getelementptr i8, ptr %scevgep54, i64 %1
  %2 = shl i64 %.725129131, 3
  %scevgep100 = getelementptr i8, ptr %scevgep99, i64 %2
  %.766 = load double, ptr %scevgep100, align 8
  %3 = mul i64 %.759, -8
  %scevgep97 = getelementptr i8, ptr %scevgep54, i64 %3
  %scevgep98 = getelementptr i8, ptr %scevgep97, i64 %2
  store double %.766, ptr %scevgep98, align 8
  %.759.1 = load i64, ptr %.638, align 8
  %4 = mul i64 %.759.1, -16
  %scevgep91 = getelementptr i8, ptr %scevgep54, i64 %4
  %scevgep92 = getelementptr i8, ptr %scevgep91, i64 %2
  %scevgep93 = getelementptr i8, ptr %scevgep92, i64 8
  %.766.1 = load double, ptr %scevgep93, align 8
  %5 = mul i64 %.759.1, -8
  %scevgep94 = getelementptr i8, ptr %scevgep54, i64 %5
  %scevgep95 = getelementptr i8, ptr %scevgep94, i64 %2
  %scevgep96 = getelementptr i8, ptr %scevgep95, i64 8
  store double %.766.1, ptr %scevgep96, align 8
  %.759.2 = load i64, ptr %.638, align 8
  %6 = mul i64 %.759.2, -16
  %scevgep85 = getelementptr i8, ptr %scevgep54, i64 %6
  %scevgep86 = getelementptr i8, ptr %scevgep85, i64 %2
  %scevgep87 = getelementptr i8, ptr %scevgep86, i64 16
  %.766.2 = load double, ptr %scevgep87, align 8
  %7 = mul i64 %.759.2, -8
  %scevgep88 = getelementptr i8, ptr %scevgep54, i64 %7
  %scevgep89 = getelementptr i8, ptr %scevgep88, i64 %2
  %scevgep90 = getelementptr i8, ptr %scevgep89, i64 16
  store double %.766.2, ptr %scevgep90, align 8
  %.759.3 = load i64, ptr %.638, align 8
  %8 = mul i64 %.759.3, -16
  %scevgep79 = getelementptr i8, ptr %scevgep54, i64 %8
  %scevgep80 = getelementptr i8, ptr %scevgep79, i64 %2
  %scevgep81 = getelementptr i8, ptr %scevgep80, i64 24
  %.766.3 = load double, ptr %scevgep81, align 8
  %9 = mul i64 %.759.3, -8
  %scevgep82 = getelementptr i8, ptr %scevgep54, i64 %9
  %scevgep83 = getelementptr i8, ptr %scevgep82, i64 %2
  %scevgep84 = getelementptr i8, ptr %scevgep83, i64 24
  store double %.766.3, ptr %scevgep84, align 8
  %.759.4 = load i64, ptr %.638, align 8
  %10 = mul i64 %.759.4, -16
  %scevgep73 = getelementptr i8, ptr %scevgep54, i64 %10
  %scevgep74 = getelementptr i8, ptr %scevgep73, i64 %2
  %scevgep75 = getelementptr i8, ptr %scevgep74, i64 32
  %.766.4 = load double, ptr %scevgep75, align 8
  %11 = mul i64 %.759.4, -8
  %scevgep76 = getelementptr i8, ptr %scevgep54, i64 %11
  %scevgep77 = getelementptr i8, ptr %scevgep76, i64 %2
  %scevgep78 = getelementptr i8, ptr %scevgep77, i64 32
  store double %.766.4, ptr %scevgep78, align 8
  %.759.5 = load i64, ptr %.638, align 8
  %12 = mul i64 %.759.5, -16
  %scevgep67 = getelementptr i8, ptr %scevgep54, i64 %12
  %scevgep68 = getelementptr i8, ptr %scevgep67, i64 %2
  %scevgep69 = getelementptr i8, ptr %scevgep68, i64 40
  %.766.5 = load double, ptr %scevgep69, align 8
  %13 = mul i64 %.759.5, -8
  %scevgep70 = getelementptr i8, ptr %scevgep54, i64 %13
  %scevgep71 = getelementptr i8, ptr %scevgep70, i64 %2
  %scevgep72 = getelementptr i8, ptr %scevgep71, i64 40
  store double %.766.5, ptr %scevgep72, align 8
  %.759.6 = load i64, ptr %.638, align 8
  %14 = mul i64 %.759.6, -16
  %scevgep61 = getelementptr i8, ptr %scevgep54, i64 %14
  %scevgep62 = getelementptr i8, ptr %scevgep61, i64 %2
  %scevgep63 = getelementptr i8, ptr %scevgep62, i64 48
  %.766.6 = load double, ptr %scevgep63, align 8
  %15 = mul i64 %.759.6, -8
  %scevgep64 = getelementptr i8, ptr %scevgep54, i64 %15
  %scevgep65 = getelementptr i8, ptr %scevgep64, i64 %2
  %scevgep66 = getelementptr i8, ptr %scevgep65, i64 48
  store double %.766.6, ptr %scevgep66, align 8
  %.732.7 = add nuw nsw i64 %.725129131, 8
  %.759.7 = load i64, ptr %.638, align 8
  %16 = mul i64 %.759.7, -16
  %scevgep55 = getelementptr i8, ptr %scevgep54, i64 %16
  %scevgep56 = getelementptr i8, ptr %scevgep55, i64 %2
  %scevgep57 = getelementptr i8, ptr %scevgep56, i64 56
  %.766.7 = load double, ptr %scevgep57, align 8
  %17 = mul i64 %.759.7, -8
  %scevgep58 = getelementptr i8, ptr %scevgep54, i64 %17
  %scevgep59 = getelementptr i8, ptr %scevgep58, i64 %2
  %scevgep60 = getelementptr i8, ptr %scevgep59, i64 56
  store double %.766.7, ptr %scevgep60, align 8
  %niter.ncmp.7 = icmp eq i64 %unroll_iter, %.732.7
  br i1 %niter.ncmp.7, label %B996.loopexit.unr-lcssa, label %B920

common.ret:
  %common.ret.op = phi i32 [ 0, %B996 ], [ 0, %B392.endif ], [ %.287, %B422.if.if ], [ %.134, %B186.if.if ], [ %.352, %B422.endif.endif.if.if ], [ %.317, %B422.endif.if.if ]
  ret i32 %common.ret.op

B996.loopexit.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B996, label %B920.epil.preheader

B920.epil.preheader:
  %.725129131.epil.init = phi i64 [ %unroll_iter, %B996.loopexit.unr-lcssa ], [ 0, %B920.preheader ]
  %18 = add i64 %.725129131.epil.init, %.12
  %19 = shl i64 %18, 3
  %scevgep49 = getelementptr i8, ptr %.pre, i64 %19
  br label %B920.epil

B920.epil:
  %lsr.iv53 = phi i64 [ %lsr.iv.next, %B920.epil ], [ %xtraiter, %B920.epil.preheader ]
  %lsr.iv = phi ptr [ %scevgep50, %B920.epil ], [ %scevgep49, %B920.epil.preheader ]
  %.759.epil = load i64, ptr %.638, align 8
  %20 = mul i64 %.759.epil, -16
  %scevgep52 = getelementptr i8, ptr %lsr.iv, i64 %20
  %.766.epil = load double, ptr %scevgep52, align 8
  %21 = mul i64 %.759.epil, -8
  %scevgep51 = getelementptr i8, ptr %lsr.iv, i64 %21
  store double %.766.epil, ptr %scevgep51, align 8
  %scevgep50 = getelementptr i8, ptr %lsr.iv, i64 8
  %lsr.iv.next = add nsw i64 %lsr.iv53, -1
  %epil.iter.cmp.not = icmp eq i64 %lsr.iv.next, 0
  br i1 %epil.iter.cmp.not, label %B996, label %B920.epil, !llvm.loop !43

B996:
  store i64 0, ptr %retptr, align 8
  br label %common.ret

B104.endif:
  %.58 = getelementptr i8, ptr %arg.r, i64 344
  %.60 = load double, ptr %.58, align 8
  %.8.i = getelementptr i8, ptr %arg.r, i64 152
  %.9.i = load i64, ptr %.8.i, align 8, !noalias !44
  %.10.i = icmp eq i64 %.9.i, 1
  %"$phi52.0.2.0.in.v.i" = select i1 %.10.i, i64 376, i64 232
  %"$phi52.0.2.0.in.i" = getelementptr i8, ptr %arg.r, i64 %"$phi52.0.2.0.in.v.i"
  %"$phi52.0.2.0.i" = load double, ptr %"$phi52.0.2.0.in.i", align 8, !noalias !44
  %.7.i10 = fsub double %.60, %"$phi52.0.2.0.i"
  %.11.i11 = fdiv double %.7.i10, %.53
  %.12.i12 = fadd double %.11.i11, 5.000000e-01
  %.13.i13 = tail call double @llvm.floor.f64(double %.12.i12)
  %.14.i14 = fptosi double %.13.i13 to i64
  %.15.i15 = sitofp i64 %.14.i14 to double
  %.16.i16 = fmul double %.53, %.15.i15
  %.17.i17 = fadd double %"$phi52.0.2.0.i", %.16.i16
  %.18.i18 = fcmp une double %.60, %.17.i17
  br i1 %.18.i18, label %B734, label %B186

B186.endif:
  %22 = inttoptr i64 %.19 to ptr
  store double 0x7FF8000000000000, ptr %22, align 8
  %.158 = getelementptr i8, ptr %arg.r, i64 8
  %.159 = load i64, ptr %.158, align 8
  %.161 = getelementptr i8, ptr %arg.r, i64 272
  %.162 = load i64, ptr %.161, align 8
  %.163 = inttoptr i64 %.162 to ptr
  %.165 = getelementptr i8, ptr %arg.r, i64 640
  %.166 = load i64, ptr %.165, align 8
  %.167 = inttoptr i64 %.166 to ptr
  %.169 = inttoptr i64 %.159 to ptr
  tail call void %.169(ptr %.163, ptr %.167, ptr nonnull %22)
  %.174 = getelementptr double, ptr %22, i64 %.12
  %.175 = load double, ptr %.174, align 8
  %.14.i20 = fcmp ugt double %.175, 0.000000e+00
  br i1 %.14.i20, label %B186.endif.endif, label %B16.i

B16.i:
  %.17.i21 = fcmp oeq double %.175, 0.000000e+00
  %"$phi54.0.2.0.i" = select i1 %.17.i21, i64 5, i64 8
  %.30.i = getelementptr i8, ptr %arg.r, i64 496
  store i64 %"$phi54.0.2.0.i", ptr %.30.i, align 8, !noalias !47
  store double 0x7FF8000000000000, ptr %22, align 8, !noalias !47
  br label %B186.endif.endif

B186.if.if:
  %.142 = icmp sgt i32 %.134, 0
  %.135 = load ptr, ptr %excinfo.3, align 8
  %.143 = select i1 %.142, ptr %.135, ptr undef
  store ptr %.143, ptr %excinfo, align 8
  br label %common.ret

B186.endif.endif:
  %.9240.not.i = icmp slt i64 %.12, 1
  br i1 %.9240.not.i, label %B422, label %iter.check.i

iter.check.i:
  %min.iters.check.i = icmp samesign ult i64 %.12, 4
  br i1 %min.iters.check.i, label %B40.i.preheader, label %vector.main.loop.iter.check.i

vector.main.loop.iter.check.i:
  %min.iters.check1.i = icmp samesign ult i64 %.12, 16
  br i1 %min.iters.check1.i, label %vec.epilog.ph.i, label %vector.ph.i

vector.ph.i:
  %n.vec.i = and i64 %.12, 9223372036854775792
  br label %vector.body.i

vector.body.i:
  %index.i = phi i64 [ 0, %vector.ph.i ], [ %index.next.i, %vector.body.i ]
  %vec.phi.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %31, %vector.body.i ]
  %vec.phi2.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %32, %vector.body.i ]
  %vec.phi3.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %33, %vector.body.i ]
  %vec.phi4.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %34, %vector.body.i ]
  %sunkaddr114 = shl i64 %index.i, 3
  %sunkaddr115 = getelementptr i8, ptr %22, i64 %sunkaddr114
  %wide.load.i = load <4 x double>, ptr %sunkaddr115, align 8, !noalias !50
  %sunkaddr119 = getelementptr i8, ptr %sunkaddr115, i64 32
  %wide.load5.i = load <4 x double>, ptr %sunkaddr119, align 8, !noalias !50
  %sunkaddr123 = getelementptr i8, ptr %sunkaddr115, i64 64
  %wide.load6.i = load <4 x double>, ptr %sunkaddr123, align 8, !noalias !50
  %sunkaddr127 = getelementptr i8, ptr %sunkaddr115, i64 96
  %wide.load7.i = load <4 x double>, ptr %sunkaddr127, align 8, !noalias !50
  %23 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load.i)
  %24 = fcmp one <4 x double> %23, splat (double 0x7FF0000000000000)
  %25 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load5.i)
  %26 = fcmp one <4 x double> %25, splat (double 0x7FF0000000000000)
  %27 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load6.i)
  %28 = fcmp one <4 x double> %27, splat (double 0x7FF0000000000000)
  %29 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load7.i)
  %30 = fcmp one <4 x double> %29, splat (double 0x7FF0000000000000)
  %31 = and <4 x i1> %vec.phi.i, %24
  %32 = and <4 x i1> %vec.phi2.i, %26
  %33 = and <4 x i1> %vec.phi3.i, %28
  %34 = and <4 x i1> %vec.phi4.i, %30
  %index.next.i = add nuw nsw i64 %index.i, 16
  %35 = icmp eq i64 %n.vec.i, %index.next.i
  br i1 %35, label %middle.block.i, label %vector.body.i, !llvm.loop !53

middle.block.i:
  %bin.rdx.i = and <4 x i1> %31, %32
  %bin.rdx8.i = and <4 x i1> %33, %bin.rdx.i
  %bin.rdx9.i = and <4 x i1> %34, %bin.rdx8.i
  %36 = bitcast <4 x i1> %bin.rdx9.i to i4
  %37 = icmp eq i4 %36, -1
  %cmp.n.i = icmp eq i64 %.12, %n.vec.i
  br i1 %cmp.n.i, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit, label %vec.epilog.iter.check.i

vec.epilog.iter.check.i:
  %38 = and i64 %.12, 12
  %min.epilog.iters.check.i = icmp eq i64 %38, 0
  br i1 %min.epilog.iters.check.i, label %B40.i.preheader, label %vec.epilog.ph.i, !prof !20

vec.epilog.ph.i:
  %vec.epilog.resume.val.i = phi i64 [ %n.vec.i, %vec.epilog.iter.check.i ], [ 0, %vector.main.loop.iter.check.i ]
  %bc.merge.rdx.i = phi i1 [ %37, %vec.epilog.iter.check.i ], [ true, %vector.main.loop.iter.check.i ]
  %n.vec11.i = and i64 %.12, 9223372036854775804
  %39 = insertelement <4 x i1> <i1 poison, i1 true, i1 true, i1 true>, i1 %bc.merge.rdx.i, i64 0
  br label %vec.epilog.vector.body.i

vec.epilog.vector.body.i:
  %index12.i = phi i64 [ %vec.epilog.resume.val.i, %vec.epilog.ph.i ], [ %index.next15.i, %vec.epilog.vector.body.i ]
  %vec.phi13.i = phi <4 x i1> [ %39, %vec.epilog.ph.i ], [ %43, %vec.epilog.vector.body.i ]
  %40 = shl i64 %index12.i, 3
  %scevgep28.i = getelementptr i8, ptr %22, i64 %40
  %wide.load14.i = load <4 x double>, ptr %scevgep28.i, align 8, !noalias !50
  %41 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load14.i)
  %42 = fcmp one <4 x double> %41, splat (double 0x7FF0000000000000)
  %43 = and <4 x i1> %vec.phi13.i, %42
  %index.next15.i = add nuw i64 %index12.i, 4
  %44 = icmp eq i64 %n.vec11.i, %index.next15.i
  br i1 %44, label %vec.epilog.middle.block.i, label %vec.epilog.vector.body.i, !llvm.loop !54

vec.epilog.middle.block.i:
  %45 = bitcast <4 x i1> %43 to i4
  %46 = icmp eq i4 %45, -1
  %cmp.n16.i = icmp eq i64 %.12, %n.vec11.i
  br i1 %cmp.n16.i, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit, label %B40.i.preheader

B40.i.preheader:
  %good.2.043.i.ph = phi i1 [ true, %iter.check.i ], [ %37, %vec.epilog.iter.check.i ], [ %46, %vec.epilog.middle.block.i ]
  %.983941.i.ph = phi i64 [ 0, %iter.check.i ], [ %n.vec.i, %vec.epilog.iter.check.i ], [ %n.vec11.i, %vec.epilog.middle.block.i ]
  br label %B40.i

B40.i:
  %good.2.043.i = phi i1 [ %.136.i, %B40.i ], [ %good.2.043.i.ph, %B40.i.preheader ]
  %.983941.i = phi i64 [ %.105.i, %B40.i ], [ %.983941.i.ph, %B40.i.preheader ]
  %.105.i = add nuw nsw i64 %.983941.i, 1
  %47 = shl i64 %.983941.i, 3
  %scevgep.i = getelementptr i8, ptr %22, i64 %47
  %.132.i = load double, ptr %scevgep.i, align 8, !noalias !50
  %48 = call double @llvm.fabs.f64(double %.132.i)
  %49 = fcmp one double %48, 0x7FF0000000000000
  %.136.i = and i1 %good.2.043.i, %49
  %exitcond.not.i = icmp eq i64 %.12, %.105.i
  br i1 %exitcond.not.i, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit, label %B40.i, !llvm.loop !55

_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit:
  %.136.lcssa.i = phi i1 [ %46, %vec.epilog.middle.block.i ], [ %37, %middle.block.i ], [ %.136.i, %B40.i ]
  br i1 %.136.lcssa.i, label %B422, label %B392.endif

B392.endif:
  %.8.i1 = getelementptr i8, ptr %arg.r, i64 496
  %.9.i2 = load i64, ptr %.8.i1, align 8, !noalias !56
  %.10.i3 = icmp eq i64 %.9.i2, 0
  %spec.select.i = select i1 %.10.i3, i64 4, i64 %.9.i2
  store i64 %spec.select.i, ptr %retptr, align 8
  br label %common.ret

B422.endif:
  %50 = inttoptr i64 %.23 to ptr
  %.310 = getelementptr double, ptr %0, i64 %.9
  %.317 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.313, ptr nonnull %excinfo.8, ptr %.310, ptr %50, i64 %.9)
  switch i32 %.317, label %B422.endif.if.if [
    i32 -2, label %B422.endif.endif
    i32 0, label %B422.endif.endif
  ], !prof !8

B422.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B422.endif.endif:
  %.341 = getelementptr i8, ptr %.174, i64 8
  %.346 = getelementptr double, ptr %50, i64 %.9
  %.352 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.348, ptr nonnull %excinfo.9, ptr %.341, ptr %.346, i64 %.9)
  switch i32 %.352, label %B422.endif.endif.if.if [
    i32 -2, label %B422.endif.endif.endif.endif
    i32 0, label %B422.endif.endif.endif.endif
  ], !prof !8

B422.endif.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B422.endif.endif.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B422.endif.endif.endif.endif:
  %.373 = shl nsw i64 %.9, 1
  %.411 = sub i64 %.12, %.373
  %.454124.not = icmp slt i64 %.411, 1
  br i1 %.454124.not, label %B668, label %B654.preheader

B654.preheader:
  %51 = shl i64 %.9, 4
  %scevgep = getelementptr i8, ptr %50, i64 %51
  %52 = shl nuw i64 %.411, 3
  tail call void @llvm.memset.p0.i64(ptr align 8 %scevgep, i8 0, i64 %52, i1 false)
  br label %B668

B756.endif:
  %.8.i4 = getelementptr i8, ptr %arg.r, i64 152
  %.9.i5 = load i64, ptr %.8.i4, align 8, !noalias !59
  %.10.i6 = icmp eq i64 %.9.i5, 1
  %"$phi52.0.2.0.in.v.i7" = select i1 %.10.i6, i64 376, i64 232
  %"$phi52.0.2.0.in.i8" = getelementptr i8, ptr %arg.r, i64 %"$phi52.0.2.0.in.v.i7"
  %"$phi52.0.2.0.i9" = load double, ptr %"$phi52.0.2.0.in.i8", align 8, !noalias !59
  %.580 = fadd double %.547, %"$phi52.0.2.0.i9"
  %.585 = getelementptr i8, ptr %arg.r, i64 344
  %.587 = load double, ptr %.585, align 8
  %.589 = fcmp ult double %.587, %.580
  br i1 %.589, label %B996, label %B824

B878.endif:
  %.638 = getelementptr i8, ptr %arg.r, i64 88
  %.639 = load i64, ptr %.638, align 8
  %.719130.not = icmp slt i64 %.639, 1
  br i1 %.719130.not, label %B996, label %B920.preheader

B920.preheader:
  %xtraiter = and i64 %.639, 7
  %53 = icmp samesign ult i64 %.639, 8
  %.pre = inttoptr i64 %.15 to ptr
  br i1 %53, label %B920.epil.preheader, label %B920.preheader.new

B920.preheader.new:
  %unroll_iter = and i64 %.639, 9223372036854775800
  %54 = shl i64 %.12, 3
  %scevgep54 = getelementptr i8, ptr %.pre, i64 %54
  br label %B920
}

define linkonce_odr i32 @_ZN18biped_adrc_kernels7measureB3v16B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r, ptr readonly %arg.x) local_unnamed_addr {
B0:
  %.3.i = alloca ptr, align 8
  %.13 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.112 = alloca ptr, align 8
  %excinfo.4 = alloca ptr, align 8
  %.7 = getelementptr i8, ptr %arg.r, i64 640
  %.8 = load i64, ptr %.7, align 8
  %.9 = inttoptr i64 %.8 to ptr
  %.10 = getelementptr i8, ptr %.9, i64 24
  %.11 = getelementptr i8, ptr %arg.r, i64 80
  %.12 = load i64, ptr %.11, align 8
  %.17 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.13, ptr nonnull %excinfo.1, ptr %arg.x, ptr %.10, i64 %.12)
  switch i32 %.17, label %common.ret [
    i32 -2, label %B0.endif.endif
    i32 0, label %B0.endif.endif
  ], !prof !8

common.ret:
  %excinfo.sink = phi ptr [ %excinfo, %B0.endif.endif.endif.if.if ], [ %excinfo, %B0 ], [ %retptr, %B0.endif.endif.endif ], [ %retptr, %B0.endif.endif.endif ]
  %common.ret.op = phi i32 [ %.116, %B0.endif.endif.endif.if.if ], [ %.17, %B0 ], [ 0, %B0.endif.endif.endif ], [ 0, %B0.endif.endif.endif ]
  store ptr null, ptr %excinfo.sink, align 8
  ret i32 %common.ret.op

B0.endif.endif:
  %.40 = getelementptr i8, ptr %arg.r, i64 344
  %.42 = load double, ptr %.40, align 8
  %.43 = getelementptr i8, ptr %arg.r, i64 512
  %.45 = load double, ptr %.43, align 8
  %.12.i = fcmp olt double %.45, %.42
  %.13.i = select i1 %.12.i, double %.45, double %.42
  %.6.i.i = getelementptr i8, ptr %arg.r, i64 352
  %.8.i.i = load double, ptr %.6.i.i, align 8, !noalias !62
  %.9.i.i = getelementptr i8, ptr %arg.r, i64 360
  %.11.i.i = load double, ptr %.9.i.i, align 8, !noalias !62
  %.13.i.i = load i64, ptr %.7, align 8, !noalias !62
  %.14.i.i = inttoptr i64 %.13.i.i to ptr
  store double %.13.i, ptr %.14.i.i, align 8, !noalias !62
  %.18.i.i = load i64, ptr %.7, align 8, !noalias !62
  %.19.i.i = inttoptr i64 %.18.i.i to ptr
  %.20.i.i = getelementptr i8, ptr %.19.i.i, i64 8
  store double %.8.i.i, ptr %.20.i.i, align 8, !noalias !62
  %.23.i.i = load i64, ptr %.7, align 8, !noalias !62
  %.24.i.i = inttoptr i64 %.23.i.i to ptr
  %.25.i.i = getelementptr i8, ptr %.24.i.i, i64 16
  store double %.11.i.i, ptr %.25.i.i, align 8, !noalias !62
  %.37.i = getelementptr i8, ptr %arg.r, i64 200
  %.38.i = load i64, ptr %.37.i, align 8, !noalias !67
  %.39.i = icmp sgt i64 %.38.i, 0
  br i1 %.39.i, label %B58.i, label %B0.endif.endif.endif

B58.i:
  %.7.i = call i32 @_ZN18biped_adrc_kernels7load_ofB2v1B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3.i, ptr nonnull poison, ptr nonnull readonly %arg.r) #0, !noalias !67
  br label %B0.endif.endif.endif

B0.endif.endif.endif:
  %.99 = getelementptr i8, ptr %arg.r, i64 656
  %.100 = load i64, ptr %.99, align 8
  %.101 = inttoptr i64 %.100 to ptr
  %.103 = load i64, ptr %.7, align 8
  %.104 = inttoptr i64 %.103 to ptr
  %.106 = load i64, ptr %.11, align 8
  %0 = getelementptr double, ptr %.104, i64 %.106
  %.108 = getelementptr i8, ptr %0, i64 24
  %.109 = getelementptr i8, ptr %arg.r, i64 72
  %.110 = load i64, ptr %.109, align 8
  %.111 = add nsw i64 %.110, 2
  %.116 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.112, ptr nonnull %excinfo.4, ptr %.101, ptr %.108, i64 %.111)
  switch i32 %.116, label %B0.endif.endif.endif.if.if [
    i32 -2, label %common.ret
    i32 0, label %common.ret
  ], !prof !8

B0.endif.endif.endif.if.if:
  br label %common.ret
}


declare double @llvm.floor.f64(double) #2


declare void @llvm.memset.p0.i64(ptr writeonly, i8, i64, i1 immarg) #3


define i64 @due(ptr %.1) local_unnamed_addr #0 {
entry:
  %.3 = alloca i64, align 8
  store i64 0, ptr %.3, align 8
  %excinfo = alloca ptr, align 8
  %.7 = call i32 @_ZN18biped_adrc_kernels3dueB3v13B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3, ptr nonnull %excinfo, ptr %.1) #0
  %cond = icmp eq i32 %.7, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.17 = load i64, ptr %.3, align 8
  ret i64 %.17
}


define i32 @_ZN18biped_adrc_kernels7laggingB3v20B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2ad10float64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r, double %arg.t, ptr readonly %arg.x, double %arg.h, ptr %arg.dx) local_unnamed_addr #0 {
B0:
  %.27 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.56 = alloca [4 x double], align 8
  %excinfo.2 = alloca ptr, align 8
  %.88 = alloca ptr, align 8
  %excinfo.3 = alloca ptr, align 8
  %.184 = alloca ptr, align 8
  %excinfo.5 = alloca ptr, align 8
  %.13 = getelementptr i8, ptr %arg.r, i64 256
  %.15 = load double, ptr %.13, align 8
  %.17 = fmul double %arg.h, %.15
  %.22 = getelementptr i8, ptr %arg.r, i64 728
  %.23 = load i64, ptr %.22, align 8
  %.24 = inttoptr i64 %.23 to ptr
  %.25 = getelementptr i8, ptr %arg.r, i64 80
  %.26 = load i64, ptr %.25, align 8
  %.31 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.27, ptr nonnull %excinfo.1, ptr %arg.x, ptr %.24, i64 %.26)
  switch i32 %.31, label %common.ret [
    i32 -2, label %B0.endif
    i32 0, label %B0.endif
  ], !prof !8

B278:
  %"$phi278.4.2.0" = phi double [ %.166, %B236.endif.endif ], [ 0.000000e+00, %B0.endif.endif.endif ]
  %.188 = call i32 @_ZN18biped_adrc_kernels11relax_slopeB3v23B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a(ptr nonnull %.184, ptr nonnull %excinfo.5, ptr nonnull %arg.r, ptr %arg.x, double %"$phi278.4.2.0", ptr %arg.dx)
  switch i32 %.188, label %B278.if.if [
    i32 -2, label %common.ret
    i32 0, label %common.ret
  ], !prof !8

B0.endif:
  %.60 = call i32 @_ZN18biped_adrc_kernels10relaxationB3v21B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAEd(ptr nonnull %.56, ptr nonnull %excinfo.2, double %.17)
  switch i32 %.60, label %common.ret [
    i32 -2, label %B0.endif.endif
    i32 0, label %B0.endif.endif
  ], !prof !8

common.ret:
  %excinfo.sink = phi ptr [ %excinfo, %B278.if.if ], [ %excinfo, %B0.endif.endif ], [ %excinfo, %B0.endif ], [ %excinfo, %B0 ], [ %retptr, %B278 ], [ %retptr, %B278 ]
  %common.ret.op = phi i32 [ %.188, %B278.if.if ], [ %.92, %B0.endif.endif ], [ %.60, %B0.endif ], [ %.31, %B0 ], [ 0, %B278 ], [ 0, %B278 ]
  store ptr null, ptr %excinfo.sink, align 8
  ret i32 %common.ret.op

B0.endif.endif:
  %.70.fca.0.load = load double, ptr %.56, align 8
  %.86 = load i64, ptr %.22, align 8
  %.87 = inttoptr i64 %.86 to ptr
  %.92 = call i32 @_ZN18biped_adrc_kernels5relaxB3v22B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a(ptr nonnull %.88, ptr nonnull %excinfo.3, ptr nonnull %arg.r, ptr %arg.x, double %.70.fca.0.load, ptr %.87)
  switch i32 %.92, label %common.ret [
    i32 -2, label %B0.endif.endif.endif
    i32 0, label %B0.endif.endif.endif
  ], !prof !8

B0.endif.endif.endif:
  %.113 = load i64, ptr %.22, align 8
  %.114 = inttoptr i64 %.113 to ptr
  %.116 = tail call ptr @flow(ptr nonnull %arg.r, double %arg.t, ptr %.114, ptr %arg.dx)
  %.119 = fcmp ogt double %arg.h, 0.000000e+00
  br i1 %.119, label %B236.endif.endif, label %B278

B236.endif.endif:
  %.12.i = fcmp ogt double %.17, 3.000000e+00
  %.17.neg = fneg double %.17
  %.161 = select i1 %.12.i, double -3.000000e+00, double %.17.neg
  %.166 = fdiv double %.161, %arg.h
  br label %B278

B278.if.if:
  br label %common.ret
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels11relax_slopeB3v23B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.r, ptr readonly %arg.x, double %arg.steep, ptr writeonly %arg.dx) local_unnamed_addr #0 {
B0.endif:
  %.17 = getelementptr i8, ptr %arg.r, i64 88
  %.18 = load i64, ptr %.17, align 8
  %.10040.not = icmp slt i64 %.18, 1
  br i1 %.10040.not, label %B160, label %B46.lr.ph

B46.lr.ph:
  %xtraiter = and i64 %.18, 3
  %0 = icmp samesign ult i64 %.18, 4
  br i1 %0, label %B46.epil.preheader, label %B46.lr.ph.new

B46.lr.ph.new:
  %1 = and i64 %.18, 9223372036854775804
  %sunkaddr21 = getelementptr i8, ptr %arg.r, i64 160
  %sunkaddr22 = getelementptr i8, ptr %arg.r, i64 80
  br label %B46

B46:
  %lsr.iv1 = phi i64 [ %lsr.iv.next2, %B46 ], [ 0, %B46.lr.ph.new ]
  %.140 = load i64, ptr %sunkaddr21, align 8
  %2 = add i64 %.140, %lsr.iv1
  %.143 = getelementptr double, ptr %arg.x, i64 %2
  %.144 = load double, ptr %.143, align 8
  %.147 = load i64, ptr %sunkaddr22, align 8
  %.150 = load i64, ptr %.17, align 8
  %3 = sub i64 %.147, %.150
  %4 = shl i64 %3, 3
  %scevgep13 = getelementptr i8, ptr %arg.x, i64 %4
  %5 = shl i64 %lsr.iv1, 3
  %scevgep20 = getelementptr i8, ptr %scevgep13, i64 %5
  %.155 = load double, ptr %scevgep20, align 8
  %.156 = fsub double %.144, %.155
  %.158 = fmul double %arg.steep, %.156
  %.164 = getelementptr double, ptr %arg.dx, i64 %2
  store double %.158, ptr %.164, align 8
  %.140.1 = load i64, ptr %sunkaddr21, align 8
  %6 = or disjoint i64 %lsr.iv1, 1
  %7 = add i64 %6, %.140.1
  %.143.1 = getelementptr double, ptr %arg.x, i64 %7
  %.144.1 = load double, ptr %.143.1, align 8
  %.147.1 = load i64, ptr %sunkaddr22, align 8
  %.150.1 = load i64, ptr %.17, align 8
  %8 = sub i64 %.147.1, %.150.1
  %9 = shl i64 %8, 3
  %scevgep10 = getelementptr i8, ptr %arg.x, i64 %9
  %scevgep18 = getelementptr i8, ptr %scevgep10, i64 %5
  %scevgep19 = getelementptr i8, ptr %scevgep18, i64 8
  %.155.1 = load double, ptr %scevgep19, align 8
  %.156.1 = fsub double %.144.1, %.155.1
  %.158.1 = fmul double %arg.steep, %.156.1
  %.164.1 = getelementptr double, ptr %arg.dx, i64 %7
  store double %.158.1, ptr %.164.1, align 8
  %.140.2 = load i64, ptr %sunkaddr21, align 8
  %10 = or disjoint i64 %lsr.iv1, 2
  %11 = add i64 %10, %.140.2
  %.143.2 = getelementptr double, ptr %arg.x, i64 %11
  %.144.2 = load double, ptr %.143.2, align 8
  %.147.2 = load i64, ptr %sunkaddr22, align 8
  %.150.2 = load i64, ptr %.17, align 8
  %12 = sub i64 %.147.2, %.150.2
  %13 = shl i64 %12, 3
  %scevgep7 = getelementptr i8, ptr %arg.x, i64 %13
  %scevgep16 = getelementptr i8, ptr %scevgep7, i64 %5
  %scevgep17 = getelementptr i8, ptr %scevgep16, i64 16
  %.155.2 = load double, ptr %scevgep17, align 8
  %.156.2 = fsub double %.144.2, %.155.2
  %.158.2 = fmul double %arg.steep, %.156.2
  %.164.2 = getelementptr double, ptr %arg.dx, i64 %11
  store double %.158.2, ptr %.164.2, align 8
  %.140.3 = load i64, ptr %sunkaddr21, align 8
  %14 = or disjoint i64 %lsr.iv1, 3
  %15 = add i64 %14, %.140.3
  %.143.3 = getelementptr double, ptr %arg.x, i64 %15
  %.144.3 = load double, ptr %.143.3, align 8
  %.147.3 = load i64, ptr %sunkaddr22, align 8
  %.150.3 = load i64, ptr %.17, align 8
  %16 = sub i64 %.147.3, %.150.3
  %17 = shl i64 %16, 3
  %scevgep5 = getelementptr i8, ptr %arg.x, i64 %17
  %scevgep3 = getelementptr i8, ptr %scevgep5, i64 %5
  %scevgep4 = getelementptr i8, ptr %scevgep3, i64 24
  %.155.3 = load double, ptr %scevgep4, align 8
  %.156.3 = fsub double %.144.3, %.155.3
  %.158.3 = fmul double %arg.steep, %.156.3
  %.164.3 = getelementptr double, ptr %arg.dx, i64 %15
  store double %.158.3, ptr %.164.3, align 8
  %lsr.iv.next2 = add nuw nsw i64 %lsr.iv1, 4
  %niter.ncmp.3 = icmp eq i64 %1, %lsr.iv.next2
  br i1 %niter.ncmp.3, label %B160.loopexit.unr-lcssa, label %B46

B160.loopexit.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B160, label %B46.epil.preheader

B46.epil.preheader:
  %.1063941.epil.init = phi i64 [ 0, %B46.lr.ph ], [ %1, %B160.loopexit.unr-lcssa ]
  %sunkaddr = getelementptr i8, ptr %arg.r, i64 160
  %sunkaddr24 = getelementptr i8, ptr %arg.r, i64 80
  br label %B46.epil

B46.epil:
  %lsr.iv = phi i64 [ %lsr.iv.next, %B46.epil ], [ %xtraiter, %B46.epil.preheader ]
  %.1063941.epil = phi i64 [ %.113.epil, %B46.epil ], [ %.1063941.epil.init, %B46.epil.preheader ]
  %.113.epil = add nuw nsw i64 %.1063941.epil, 1
  %.140.epil = load i64, ptr %sunkaddr, align 8
  %18 = add i64 %.140.epil, %.1063941.epil
  %.143.epil = getelementptr double, ptr %arg.x, i64 %18
  %.144.epil = load double, ptr %.143.epil, align 8
  %.147.epil = load i64, ptr %sunkaddr24, align 8
  %.150.epil = load i64, ptr %.17, align 8
  %19 = sub i64 %.147.epil, %.150.epil
  %20 = shl i64 %19, 3
  %scevgep = getelementptr i8, ptr %arg.x, i64 %20
  %21 = shl i64 %.1063941.epil, 3
  %scevgep2 = getelementptr i8, ptr %scevgep, i64 %21
  %.155.epil = load double, ptr %scevgep2, align 8
  %.156.epil = fsub double %.144.epil, %.155.epil
  %.158.epil = fmul double %arg.steep, %.156.epil
  %.164.epil = getelementptr double, ptr %arg.dx, i64 %18
  store double %.158.epil, ptr %.164.epil, align 8
  %lsr.iv.next = add nsw i64 %lsr.iv, -1
  %epil.iter.cmp.not = icmp eq i64 %lsr.iv.next, 0
  br i1 %epil.iter.cmp.not, label %B160, label %B46.epil, !llvm.loop !68

B160:
  store ptr null, ptr %retptr, align 8
  ret i32 0
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels10relaxationB3v21B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAEd(ptr noalias writeonly initializes((0, 32)) %retptr, ptr noalias readnone %excinfo, double %arg.theta) local_unnamed_addr #0 {
B0:
  %.8 = fneg double %arg.theta
  %.9 = tail call double @llvm.exp.f64(double %.8)
  %.14 = fcmp olt double %arg.theta, 1.000000e+00
  br i1 %.14, label %B58.endif.endif.endif, label %B176

B176:
  %.193 = fsub double 1.000000e+00, %.9
  %.198 = fdiv double %.193, %arg.theta
  %.202 = fsub double %.198, %.9
  %.207 = fdiv double %.202, %arg.theta
  %.210 = fmul double %.207, 2.000000e+00
  %.212 = fsub double %.210, %.9
  %.217 = fdiv double %.212, %arg.theta
  br label %B230

B230:
  %.224.pre-phi = phi double [ %.210, %B176 ], [ %.pre, %B58.endif.endif.endif ]
  %m2.4.0 = phi double [ %.217, %B176 ], [ %.157.17, %B58.endif.endif.endif ]
  %m1.2.0 = phi double [ %.207, %B176 ], [ %.178, %B58.endif.endif.endif ]
  %m0.2.0 = phi double [ %.198, %B176 ], [ %.187, %B58.endif.endif.endif ]
  %.226 = fsub double %.224.pre-phi, %m0.2.0
  %.227 = fmul double %.226, 3.000000e+00
  %.229 = fmul double %m2.4.0, 6.000000e+00
  %.233 = fmul double %m1.2.0, 6.000000e+00
  %.236 = fsub double %.229, %.233
  %.238 = fadd double %m0.2.0, %.236
  %.239 = fmul double %.238, 5.000000e+00
  %.241 = fsub double %m0.2.0, %.227
  %.242 = fadd double %.241, %.239
  %.243 = fmul double %.239, 5.000000e-01
  %.245 = fsub double %m0.2.0, %.243
  %.247 = fadd double %m0.2.0, %.227
  %.250 = fadd double %.247, %.239
  store double %.242, ptr %retptr, align 8
  %retptr.repack38 = getelementptr inbounds nuw i8, ptr %retptr, i64 8
  store double %.245, ptr %retptr.repack38, align 8
  %retptr.repack40 = getelementptr inbounds nuw i8, ptr %retptr, i64 16
  store double %.250, ptr %retptr.repack40, align 8
  %retptr.repack42 = getelementptr inbounds nuw i8, ptr %retptr, i64 24
  store double %.9, ptr %retptr.repack42, align 8
  ret i32 0

B58.endif.endif.endif:
  %.20 = fdiv double %.9, 3.000000e+00
  %.151 = fmul double %arg.theta, 2.500000e-01
  %.153 = fmul double %.151, %.20
  %.157 = fadd double %.20, %.153
  %.151.1 = fdiv double %arg.theta, 5.000000e+00
  %.153.1 = fmul double %.151.1, %.153
  %.157.1 = fadd double %.157, %.153.1
  %.151.2 = fdiv double %arg.theta, 6.000000e+00
  %.153.2 = fmul double %.151.2, %.153.1
  %.157.2 = fadd double %.157.1, %.153.2
  %.151.3 = fdiv double %arg.theta, 7.000000e+00
  %.153.3 = fmul double %.151.3, %.153.2
  %.157.3 = fadd double %.157.2, %.153.3
  %.151.4 = fmul double %arg.theta, 1.250000e-01
  %.153.4 = fmul double %.151.4, %.153.3
  %.157.4 = fadd double %.157.3, %.153.4
  %.151.5 = fdiv double %arg.theta, 9.000000e+00
  %.153.5 = fmul double %.151.5, %.153.4
  %.157.5 = fadd double %.157.4, %.153.5
  %.151.6 = fdiv double %arg.theta, 1.000000e+01
  %.153.6 = fmul double %.151.6, %.153.5
  %.157.6 = fadd double %.157.5, %.153.6
  %.151.7 = fdiv double %arg.theta, 1.100000e+01
  %.153.7 = fmul double %.151.7, %.153.6
  %.157.7 = fadd double %.157.6, %.153.7
  %.151.8 = fdiv double %arg.theta, 1.200000e+01
  %.153.8 = fmul double %.151.8, %.153.7
  %.157.8 = fadd double %.157.7, %.153.8
  %.151.9 = fdiv double %arg.theta, 1.300000e+01
  %.153.9 = fmul double %.151.9, %.153.8
  %.157.9 = fadd double %.157.8, %.153.9
  %.151.10 = fdiv double %arg.theta, 1.400000e+01
  %.153.10 = fmul double %.151.10, %.153.9
  %.157.10 = fadd double %.157.9, %.153.10
  %.151.11 = fdiv double %arg.theta, 1.500000e+01
  %.153.11 = fmul double %.151.11, %.153.10
  %.157.11 = fadd double %.157.10, %.153.11
  %.151.12 = fmul double %arg.theta, 6.250000e-02
  %.153.12 = fmul double %.151.12, %.153.11
  %.157.12 = fadd double %.157.11, %.153.12
  %.151.13 = fdiv double %arg.theta, 1.700000e+01
  %.153.13 = fmul double %.151.13, %.153.12
  %.157.13 = fadd double %.157.12, %.153.13
  %.151.14 = fdiv double %arg.theta, 1.800000e+01
  %.153.14 = fmul double %.151.14, %.153.13
  %.157.14 = fadd double %.157.13, %.153.14
  %.151.15 = fdiv double %arg.theta, 1.900000e+01
  %.153.15 = fmul double %.151.15, %.153.14
  %.157.15 = fadd double %.157.14, %.153.15
  %.151.16 = fdiv double %arg.theta, 2.000000e+01
  %.153.16 = fmul double %.151.16, %.153.15
  %.157.16 = fadd double %.157.15, %.153.16
  %.151.17 = fdiv double %arg.theta, 2.100000e+01
  %.153.17 = fmul double %.151.17, %.153.16
  %.157.17 = fadd double %.157.16, %.153.17
  %.173 = fmul double %arg.theta, %.157.17
  %.177 = fadd double %.9, %.173
  %.178 = fmul double %.177, 5.000000e-01
  %.183 = fmul double %arg.theta, %.178
  %.187 = fadd double %.9, %.183
  %.pre = fmul double %.178, 2.000000e+00
  br label %B230
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels5relaxB3v22B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.r, ptr readonly %arg.x, double %arg.weight, ptr writeonly %arg.out) local_unnamed_addr #0 {
B0.endif:
  %.17 = getelementptr i8, ptr %arg.r, i64 88
  %.18 = load i64, ptr %.17, align 8
  %.10040.not = icmp slt i64 %.18, 1
  br i1 %.10040.not, label %B170, label %B46.lr.ph

B46.lr.ph:
  %xtraiter = and i64 %.18, 3
  %0 = icmp samesign ult i64 %.18, 4
  br i1 %0, label %B46.epil.preheader, label %B46.lr.ph.new

B46.lr.ph.new:
  %1 = and i64 %.18, 9223372036854775804
  %sunkaddr21 = getelementptr i8, ptr %arg.r, i64 80
  %sunkaddr23 = getelementptr i8, ptr %arg.r, i64 160
  br label %B46

B46:
  %lsr.iv1 = phi i64 [ %lsr.iv.next2, %B46 ], [ 0, %B46.lr.ph.new ]
  %.140 = load i64, ptr %sunkaddr21, align 8
  %.143 = load i64, ptr %.17, align 8
  %2 = sub i64 %.140, %.143
  %3 = shl i64 %2, 3
  %scevgep13 = getelementptr i8, ptr %arg.x, i64 %3
  %4 = shl i64 %lsr.iv1, 3
  %scevgep20 = getelementptr i8, ptr %scevgep13, i64 %4
  %.148 = load double, ptr %scevgep20, align 8
  %.151 = load i64, ptr %sunkaddr23, align 8
  %5 = add i64 %.151, %lsr.iv1
  %.154 = getelementptr double, ptr %arg.x, i64 %5
  %.155 = load double, ptr %.154, align 8
  %.156 = fsub double %.155, %.148
  %.158 = fmul double %arg.weight, %.156
  %.159 = fadd double %.148, %.158
  %.165 = getelementptr double, ptr %arg.out, i64 %5
  store double %.159, ptr %.165, align 8
  %.140.1 = load i64, ptr %sunkaddr21, align 8
  %.143.1 = load i64, ptr %.17, align 8
  %6 = sub i64 %.140.1, %.143.1
  %7 = shl i64 %6, 3
  %scevgep10 = getelementptr i8, ptr %arg.x, i64 %7
  %scevgep18 = getelementptr i8, ptr %scevgep10, i64 %4
  %scevgep19 = getelementptr i8, ptr %scevgep18, i64 8
  %.148.1 = load double, ptr %scevgep19, align 8
  %.151.1 = load i64, ptr %sunkaddr23, align 8
  %8 = or disjoint i64 %lsr.iv1, 1
  %9 = add i64 %8, %.151.1
  %.154.1 = getelementptr double, ptr %arg.x, i64 %9
  %.155.1 = load double, ptr %.154.1, align 8
  %.156.1 = fsub double %.155.1, %.148.1
  %.158.1 = fmul double %arg.weight, %.156.1
  %.159.1 = fadd double %.148.1, %.158.1
  %.165.1 = getelementptr double, ptr %arg.out, i64 %9
  store double %.159.1, ptr %.165.1, align 8
  %.140.2 = load i64, ptr %sunkaddr21, align 8
  %.143.2 = load i64, ptr %.17, align 8
  %10 = sub i64 %.140.2, %.143.2
  %11 = shl i64 %10, 3
  %scevgep7 = getelementptr i8, ptr %arg.x, i64 %11
  %scevgep16 = getelementptr i8, ptr %scevgep7, i64 %4
  %scevgep17 = getelementptr i8, ptr %scevgep16, i64 16
  %.148.2 = load double, ptr %scevgep17, align 8
  %.151.2 = load i64, ptr %sunkaddr23, align 8
  %12 = or disjoint i64 %lsr.iv1, 2
  %13 = add i64 %12, %.151.2
  %.154.2 = getelementptr double, ptr %arg.x, i64 %13
  %.155.2 = load double, ptr %.154.2, align 8
  %.156.2 = fsub double %.155.2, %.148.2
  %.158.2 = fmul double %arg.weight, %.156.2
  %.159.2 = fadd double %.148.2, %.158.2
  %.165.2 = getelementptr double, ptr %arg.out, i64 %13
  store double %.159.2, ptr %.165.2, align 8
  %.140.3 = load i64, ptr %sunkaddr21, align 8
  %.143.3 = load i64, ptr %.17, align 8
  %14 = sub i64 %.140.3, %.143.3
  %15 = shl i64 %14, 3
  %scevgep3 = getelementptr i8, ptr %arg.x, i64 %15
  %scevgep4 = getelementptr i8, ptr %scevgep3, i64 %4
  %scevgep5 = getelementptr i8, ptr %scevgep4, i64 24
  %.148.3 = load double, ptr %scevgep5, align 8
  %.151.3 = load i64, ptr %sunkaddr23, align 8
  %16 = or disjoint i64 %lsr.iv1, 3
  %17 = add i64 %16, %.151.3
  %.154.3 = getelementptr double, ptr %arg.x, i64 %17
  %.155.3 = load double, ptr %.154.3, align 8
  %.156.3 = fsub double %.155.3, %.148.3
  %.158.3 = fmul double %arg.weight, %.156.3
  %.159.3 = fadd double %.148.3, %.158.3
  %.165.3 = getelementptr double, ptr %arg.out, i64 %17
  store double %.159.3, ptr %.165.3, align 8
  %lsr.iv.next2 = add nuw nsw i64 %lsr.iv1, 4
  %niter.ncmp.3 = icmp eq i64 %1, %lsr.iv.next2
  br i1 %niter.ncmp.3, label %B170.loopexit.unr-lcssa, label %B46

B170.loopexit.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B170, label %B46.epil.preheader

B46.epil.preheader:
  %.1063941.epil.init = phi i64 [ 0, %B46.lr.ph ], [ %1, %B170.loopexit.unr-lcssa ]
  %sunkaddr = getelementptr i8, ptr %arg.r, i64 80
  %sunkaddr25 = getelementptr i8, ptr %arg.r, i64 160
  br label %B46.epil

B46.epil:
  %lsr.iv = phi i64 [ %lsr.iv.next, %B46.epil ], [ %xtraiter, %B46.epil.preheader ]
  %.1063941.epil = phi i64 [ %.113.epil, %B46.epil ], [ %.1063941.epil.init, %B46.epil.preheader ]
  %.113.epil = add nuw nsw i64 %.1063941.epil, 1
  %.140.epil = load i64, ptr %sunkaddr, align 8
  %.143.epil = load i64, ptr %.17, align 8
  %18 = sub i64 %.140.epil, %.143.epil
  %19 = shl i64 %18, 3
  %scevgep = getelementptr i8, ptr %arg.x, i64 %19
  %20 = shl i64 %.1063941.epil, 3
  %scevgep2 = getelementptr i8, ptr %scevgep, i64 %20
  %.148.epil = load double, ptr %scevgep2, align 8
  %.151.epil = load i64, ptr %sunkaddr25, align 8
  %21 = add i64 %.151.epil, %.1063941.epil
  %.154.epil = getelementptr double, ptr %arg.x, i64 %21
  %.155.epil = load double, ptr %.154.epil, align 8
  %.156.epil = fsub double %.155.epil, %.148.epil
  %.158.epil = fmul double %arg.weight, %.156.epil
  %.159.epil = fadd double %.148.epil, %.158.epil
  %.165.epil = getelementptr double, ptr %arg.out, i64 %21
  store double %.159.epil, ptr %.165.epil, align 8
  %lsr.iv.next = add nsw i64 %lsr.iv, -1
  %epil.iter.cmp.not = icmp eq i64 %lsr.iv.next, 0
  br i1 %epil.iter.cmp.not, label %B170, label %B46.epil, !llvm.loop !69

B170:
  store ptr null, ptr %retptr, align 8
  ret i32 0
}


declare double @llvm.exp.f64(double) #2


define ptr @lagging(ptr %.1, double %.2, ptr readonly %.3, double %.4, ptr %.5) local_unnamed_addr #0 {
entry:
  %.7 = alloca ptr, align 8
  store ptr null, ptr %.7, align 8
  %excinfo = alloca ptr, align 8
  %.11 = call i32 @_ZN18biped_adrc_kernels7laggingB3v20B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2ad10float64_2a(ptr nonnull %.7, ptr nonnull %excinfo, ptr %.1, double %.2, ptr %.3, double %.4, ptr %.5) #0
  %cond = icmp eq i32 %.11, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.21 = load ptr, ptr %.7, align 8
  ret ptr %.21
}


define i32 @_ZN18biped_adrc_kernels9classicalB3v24B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2a10float64_2ad10float64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r, double %arg.t, ptr %arg.x, ptr readonly %arg.dx, double %arg.h, ptr writeonly %arg.out) local_unnamed_addr #0 {
B0:
  %.91 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.154 = alloca [4 x double], align 8
  %excinfo.2 = alloca ptr, align 8
  call void @llvm.memset.p0.i64(ptr nonnull align 8 dereferenceable(32) %.154, i8 0, i64 32, i1 false)
  %.223 = alloca ptr, align 8
  %excinfo.3 = alloca ptr, align 8
  %.257 = alloca ptr, align 8
  %excinfo.4 = alloca ptr, align 8
  %.303 = alloca ptr, align 8
  %excinfo.5 = alloca ptr, align 8
  %.337 = alloca ptr, align 8
  %excinfo.6 = alloca ptr, align 8
  %.386 = alloca ptr, align 8
  %excinfo.7 = alloca ptr, align 8
  %.420 = alloca ptr, align 8
  %excinfo.8 = alloca ptr, align 8
  %.471 = alloca ptr, align 8
  %excinfo.9 = alloca ptr, align 8
  %.515 = alloca ptr, align 8
  %excinfo.10 = alloca ptr, align 8
  %.555 = alloca ptr, align 8
  %excinfo.11 = alloca ptr, align 8
  %.23 = getelementptr i8, ptr %arg.r, i64 96
  %.24 = load i64, ptr %.23, align 8
  %.26 = getelementptr i8, ptr %arg.r, i64 80
  %.27 = load i64, ptr %.26, align 8
  %.31 = sub nsw i64 %.27, %.24
  %.33 = getelementptr i8, ptr %arg.r, i64 728
  %.34 = load i64, ptr %.33, align 8
  %.67 = icmp sgt i64 %.31, 0
  br i1 %.67, label %B92, label %B244

B92:
  %0 = inttoptr i64 %.34 to ptr
  %.74 = getelementptr i8, ptr %arg.r, i64 88
  %.75 = load i64, ptr %.74, align 8
  %.76 = sub nsw i64 %.27, %.75
  %.78 = getelementptr double, ptr %arg.x, i64 %.76
  %.87 = getelementptr double, ptr %0, i64 %.76
  %.95 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.91, ptr nonnull %excinfo.1, ptr %.78, ptr %.87, i64 %.75)
  switch i32 %.95, label %common.ret [
    i32 -2, label %B244
    i32 0, label %B244
  ], !prof !8

B244:
  %.143 = getelementptr i8, ptr %arg.r, i64 160
  %.144 = load i64, ptr %.143, align 8
  %.145 = icmp sgt i64 %.144, 0
  br i1 %.145, label %B266, label %B384

B266:
  %.149 = getelementptr i8, ptr %arg.r, i64 256
  %.151 = load double, ptr %.149, align 8
  %.153 = fmul double %arg.h, %.151
  %.158 = call i32 @_ZN18biped_adrc_kernels10relaxationB3v21B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAEd(ptr nonnull %.154, ptr nonnull %excinfo.2, double %.153)
  switch i32 %.158, label %common.ret [
    i32 -2, label %B266.endif
    i32 0, label %B266.endif
  ], !prof !8

B384:
  %dx.2.0 = phi ptr [ %.212, %B266.endif ], [ %arg.dx, %B244 ]
  %middle.2.0 = phi double [ %.168.fca.1.load, %B266.endif ], [ 0.000000e+00, %B244 ]
  %last.2.0 = phi double [ %.168.fca.2.load, %B266.endif ], [ 0.000000e+00, %B244 ]
  %end.2.0 = phi double [ %.168.fca.3.load, %B266.endif ], [ 0.000000e+00, %B244 ]
  %1 = inttoptr i64 %.34 to ptr
  %.218 = fmul double %arg.h, 5.000000e-01
  %.227 = call i32 @_ZN18biped_adrc_kernels3addB2v2B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ad10float64_2a10float64_2ax(ptr nonnull %.223, ptr nonnull %excinfo.3, ptr %arg.x, double %.218, ptr %dx.2.0, ptr %1, i64 %.24)
  switch i32 %.227, label %common.ret [
    i32 -2, label %B384.endif
    i32 0, label %B384.endif
  ], !prof !8

B450:
  %.261 = call i32 @_ZN18biped_adrc_kernels5relaxB3v22B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a(ptr nonnull %.257, ptr nonnull %excinfo.4, ptr nonnull %arg.r, ptr %arg.x, double %middle.2.0, ptr %1)
  switch i32 %.261, label %common.ret [
    i32 -2, label %B486
    i32 0, label %B486
  ], !prof !8

B486:
  %.285 = fadd double %arg.t, %.218
  %.287 = getelementptr i8, ptr %arg.r, i64 744
  %.288 = load i64, ptr %.287, align 8
  %.289 = inttoptr i64 %.288 to ptr
  %.292 = tail call ptr @flow(ptr nonnull %arg.r, double %.285, ptr %1, ptr %.289)
  %.298 = load i64, ptr %.287, align 8
  %.299 = inttoptr i64 %.298 to ptr
  %.307 = call i32 @_ZN18biped_adrc_kernels3addB2v2B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ad10float64_2a10float64_2ax(ptr nonnull %.303, ptr nonnull %excinfo.5, ptr %arg.x, double %.218, ptr %.299, ptr %1, i64 %.24)
  switch i32 %.307, label %common.ret [
    i32 -2, label %B486.endif
    i32 0, label %B486.endif
  ], !prof !8

B620:
  %.341 = call i32 @_ZN18biped_adrc_kernels5relaxB3v22B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a(ptr nonnull %.337, ptr nonnull %excinfo.6, ptr nonnull %arg.r, ptr %arg.x, double %middle.2.0, ptr %1)
  switch i32 %.341, label %common.ret [
    i32 -2, label %B656
    i32 0, label %B656
  ], !prof !8

B656:
  %.371 = getelementptr i8, ptr %arg.r, i64 752
  %.372 = load i64, ptr %.371, align 8
  %.373 = inttoptr i64 %.372 to ptr
  %.376 = tail call ptr @flow(ptr nonnull %arg.r, double %.285, ptr %1, ptr %.373)
  %.380 = load i64, ptr %.371, align 8
  %.381 = inttoptr i64 %.380 to ptr
  %.390 = call i32 @_ZN18biped_adrc_kernels3addB2v2B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ad10float64_2a10float64_2ax(ptr nonnull %.386, ptr nonnull %excinfo.7, ptr %arg.x, double %arg.h, ptr %.381, ptr %1, i64 %.24)
  switch i32 %.390, label %common.ret [
    i32 -2, label %B656.endif
    i32 0, label %B656.endif
  ], !prof !8

B784:
  %.424 = call i32 @_ZN18biped_adrc_kernels5relaxB3v22B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a(ptr nonnull %.420, ptr nonnull %excinfo.8, ptr nonnull %arg.r, ptr %arg.x, double %last.2.0, ptr %1)
  switch i32 %.424, label %common.ret [
    i32 -2, label %B820
    i32 0, label %B820
  ], !prof !8

B820:
  %.451 = fadd double %arg.t, %arg.h
  %.455 = getelementptr i8, ptr %arg.r, i64 760
  %.456 = load i64, ptr %.455, align 8
  %.457 = inttoptr i64 %.456 to ptr
  %.460 = tail call ptr @flow(ptr nonnull %arg.r, double %.451, ptr %1, ptr %.457)
  %.466 = getelementptr double, ptr %arg.x, i64 %.24
  %.469 = getelementptr double, ptr %arg.out, i64 %.24
  %.475 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.471, ptr nonnull %excinfo.9, ptr %.466, ptr %.469, i64 %.31)
  switch i32 %.475, label %common.ret [
    i32 -2, label %B820.endif
    i32 0, label %B820.endif
  ], !prof !8

B1058:
  %.559 = call i32 @_ZN18biped_adrc_kernels5relaxB3v22B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a(ptr nonnull %.555, ptr nonnull %excinfo.11, ptr nonnull %arg.r, ptr %arg.x, double %end.2.0, ptr %arg.out)
  switch i32 %.559, label %B1058.if.if [
    i32 -2, label %common.ret
    i32 0, label %common.ret
  ], !prof !8

common.ret:
  %excinfo.sink = phi ptr [ %excinfo, %B1058.if.if ], [ %excinfo, %B820.endif ], [ %excinfo, %B820 ], [ %excinfo, %B784 ], [ %excinfo, %B656 ], [ %excinfo, %B620 ], [ %excinfo, %B486 ], [ %excinfo, %B450 ], [ %excinfo, %B384 ], [ %excinfo, %B266 ], [ %excinfo, %B92 ], [ %retptr, %B820.endif.endif ], [ %retptr, %B1058 ], [ %retptr, %B1058 ]
  %common.ret.op = phi i32 [ %.559, %B1058.if.if ], [ %.519, %B820.endif ], [ %.475, %B820 ], [ %.424, %B784 ], [ %.390, %B656 ], [ %.341, %B620 ], [ %.307, %B486 ], [ %.261, %B450 ], [ %.227, %B384 ], [ %.158, %B266 ], [ %.95, %B92 ], [ 0, %B820.endif.endif ], [ 0, %B1058 ], [ 0, %B1058 ]
  store ptr null, ptr %excinfo.sink, align 8
  ret i32 %common.ret.op

B266.endif:
  %sunkaddr = getelementptr inbounds nuw i8, ptr %.154, i64 24
  %.168.fca.3.load = load double, ptr %sunkaddr, align 8
  %sunkaddr1 = getelementptr inbounds nuw i8, ptr %.154, i64 16
  %.168.fca.2.load = load double, ptr %sunkaddr1, align 8
  %sunkaddr2 = getelementptr inbounds nuw i8, ptr %.154, i64 8
  %.168.fca.1.load = load double, ptr %sunkaddr2, align 8
  %.201 = getelementptr i8, ptr %arg.r, i64 736
  %.202 = load i64, ptr %.201, align 8
  %.203 = inttoptr i64 %.202 to ptr
  %.208 = tail call ptr @lagging(ptr nonnull %arg.r, double %arg.t, ptr %arg.x, double %arg.h, ptr %.203)
  %.211 = load i64, ptr %.201, align 8
  %.212 = inttoptr i64 %.211 to ptr
  br label %B384

B384.endif:
  %.249 = load i64, ptr %.143, align 8
  %.250 = icmp sgt i64 %.249, 0
  br i1 %.250, label %B450, label %B486

B486.endif:
  %.329 = load i64, ptr %.143, align 8
  %.330 = icmp sgt i64 %.329, 0
  br i1 %.330, label %B620, label %B656

B656.endif:
  %.412 = load i64, ptr %.143, align 8
  %.413 = icmp sgt i64 %.412, 0
  br i1 %.413, label %B784, label %B820

B820.endif:
  %.500 = load i64, ptr %.287, align 8
  %.501 = inttoptr i64 %.500 to ptr
  %.504 = load i64, ptr %.371, align 8
  %.505 = inttoptr i64 %.504 to ptr
  %.508 = load i64, ptr %.455, align 8
  %.509 = inttoptr i64 %.508 to ptr
  %.519 = call i32 @_ZN18biped_adrc_kernels7rk4_sumB3v25B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ad10float64_2a10float64_2a10float64_2a10float64_2a10float64_2ax(ptr nonnull %.515, ptr nonnull %excinfo.10, ptr %arg.x, double %arg.h, ptr %dx.2.0, ptr %.501, ptr %.505, ptr %.509, ptr %arg.out, i64 %.24)
  switch i32 %.519, label %common.ret [
    i32 -2, label %B820.endif.endif
    i32 0, label %B820.endif.endif
  ], !prof !8

B820.endif.endif:
  %.547 = load i64, ptr %.143, align 8
  %.548 = icmp sgt i64 %.547, 0
  br i1 %.548, label %B1058, label %common.ret

B1058.if.if:
  br label %common.ret
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels3addB2v2B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ad10float64_2a10float64_2ax(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.x, double %arg.h, ptr readonly %arg.dx, ptr writeonly %arg.out, i64 %arg.size) local_unnamed_addr #0 {
B0.endif:
  %.9840.not = icmp slt i64 %arg.size, 1
  br i1 %.9840.not, label %B86, label %iter.check

iter.check:
  %min.iters.check = icmp samesign ult i64 %arg.size, 4
  br i1 %min.iters.check, label %B36.preheader, label %vector.memcheck

vector.memcheck:
  %0 = ptrtoint ptr %arg.out to i64
  %1 = ptrtoint ptr %arg.x to i64
  %2 = ptrtoint ptr %arg.dx to i64
  %3 = sub i64 %0, %1
  %diff.check = icmp ult i64 %3, 128
  %4 = sub i64 %0, %2
  %diff.check4 = icmp ult i64 %4, 128
  %conflict.rdx = or i1 %diff.check, %diff.check4
  br i1 %conflict.rdx, label %B36.preheader, label %vector.main.loop.iter.check

vector.main.loop.iter.check:
  %min.iters.check5 = icmp samesign ult i64 %arg.size, 16
  br i1 %min.iters.check5, label %vector.main.loop.iter.check.vec.epilog.ph_crit_edge, label %vector.ph

vector.main.loop.iter.check.vec.epilog.ph_crit_edge:
  %.pre = insertelement <4 x double> poison, double %arg.h, i64 0
  %.pre3 = shufflevector <4 x double> %.pre, <4 x double> poison, <4 x i32> zeroinitializer
  br label %vec.epilog.ph

vector.ph:
  %n.vec = and i64 %arg.size, 9223372036854775792
  %broadcast.splatinsert = insertelement <4 x double> poison, double %arg.h, i64 0
  %broadcast.splat = shufflevector <4 x double> %broadcast.splatinsert, <4 x double> poison, <4 x i32> zeroinitializer
  br label %vector.body

vector.body:
  %index = phi i64 [ 0, %vector.ph ], [ %index.next, %vector.body ]
  %sunkaddr84 = shl i64 %index, 3
  %sunkaddr85 = getelementptr i8, ptr %arg.x, i64 %sunkaddr84
  %wide.load = load <4 x double>, ptr %sunkaddr85, align 8
  %sunkaddr88 = getelementptr i8, ptr %sunkaddr85, i64 32
  %wide.load6 = load <4 x double>, ptr %sunkaddr88, align 8
  %sunkaddr91 = getelementptr i8, ptr %sunkaddr85, i64 64
  %wide.load7 = load <4 x double>, ptr %sunkaddr91, align 8
  %sunkaddr93 = getelementptr i8, ptr %sunkaddr85, i64 96
  %wide.load8 = load <4 x double>, ptr %sunkaddr93, align 8
  %sunkaddr95 = getelementptr i8, ptr %arg.dx, i64 %sunkaddr84
  %wide.load9 = load <4 x double>, ptr %sunkaddr95, align 8
  %sunkaddr98 = getelementptr i8, ptr %sunkaddr95, i64 32
  %wide.load10 = load <4 x double>, ptr %sunkaddr98, align 8
  %sunkaddr101 = getelementptr i8, ptr %sunkaddr95, i64 64
  %wide.load11 = load <4 x double>, ptr %sunkaddr101, align 8
  %sunkaddr104 = getelementptr i8, ptr %sunkaddr95, i64 96
  %wide.load12 = load <4 x double>, ptr %sunkaddr104, align 8
  %5 = fmul <4 x double> %broadcast.splat, %wide.load9
  %6 = fmul <4 x double> %broadcast.splat, %wide.load10
  %7 = fmul <4 x double> %broadcast.splat, %wide.load11
  %8 = fmul <4 x double> %broadcast.splat, %wide.load12
  %9 = fadd <4 x double> %wide.load, %5
  %10 = fadd <4 x double> %wide.load6, %6
  %11 = fadd <4 x double> %wide.load7, %7
  %12 = fadd <4 x double> %wide.load8, %8
  %sunkaddr106 = getelementptr i8, ptr %arg.out, i64 %sunkaddr84
  store <4 x double> %9, ptr %sunkaddr106, align 8
  %sunkaddr109 = getelementptr i8, ptr %sunkaddr106, i64 32
  store <4 x double> %10, ptr %sunkaddr109, align 8
  %sunkaddr112 = getelementptr i8, ptr %sunkaddr106, i64 64
  store <4 x double> %11, ptr %sunkaddr112, align 8
  %sunkaddr115 = getelementptr i8, ptr %sunkaddr106, i64 96
  store <4 x double> %12, ptr %sunkaddr115, align 8
  %index.next = add nuw nsw i64 %index, 16
  %13 = icmp eq i64 %n.vec, %index.next
  br i1 %13, label %middle.block, label %vector.body, !llvm.loop !70

middle.block:
  %cmp.n = icmp eq i64 %arg.size, %n.vec
  br i1 %cmp.n, label %B86, label %vec.epilog.iter.check

vec.epilog.iter.check:
  %14 = and i64 %arg.size, 12
  %min.epilog.iters.check = icmp eq i64 %14, 0
  br i1 %min.epilog.iters.check, label %B36.preheader, label %vec.epilog.ph, !prof !20

vec.epilog.ph:
  %broadcast.splat16.pre-phi = phi <4 x double> [ %.pre3, %vector.main.loop.iter.check.vec.epilog.ph_crit_edge ], [ %broadcast.splat, %vec.epilog.iter.check ]
  %vec.epilog.resume.val = phi i64 [ 0, %vector.main.loop.iter.check.vec.epilog.ph_crit_edge ], [ %n.vec, %vec.epilog.iter.check ]
  %n.vec14 = and i64 %arg.size, 9223372036854775804
  br label %vec.epilog.vector.body

vec.epilog.vector.body:
  %index17 = phi i64 [ %vec.epilog.resume.val, %vec.epilog.ph ], [ %index.next20, %vec.epilog.vector.body ]
  %15 = shl i64 %index17, 3
  %scevgep75 = getelementptr i8, ptr %arg.x, i64 %15
  %wide.load18 = load <4 x double>, ptr %scevgep75, align 8
  %scevgep74 = getelementptr i8, ptr %arg.dx, i64 %15
  %wide.load19 = load <4 x double>, ptr %scevgep74, align 8
  %16 = fmul <4 x double> %broadcast.splat16.pre-phi, %wide.load19
  %17 = fadd <4 x double> %wide.load18, %16
  %scevgep55 = getelementptr i8, ptr %arg.out, i64 %15
  store <4 x double> %17, ptr %scevgep55, align 8
  %index.next20 = add nuw i64 %index17, 4
  %18 = icmp eq i64 %n.vec14, %index.next20
  br i1 %18, label %vec.epilog.middle.block, label %vec.epilog.vector.body, !llvm.loop !71

vec.epilog.middle.block:
  %cmp.n21 = icmp eq i64 %arg.size, %n.vec14
  br i1 %cmp.n21, label %B86, label %B36.preheader

B36.preheader:
  %.1043941.ph = phi i64 [ 0, %iter.check ], [ 0, %vector.memcheck ], [ %n.vec, %vec.epilog.iter.check ], [ %n.vec14, %vec.epilog.middle.block ]
  %19 = sub nsw i64 %arg.size, %.1043941.ph
  %xtraiter = and i64 %19, 7
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B36.prol.loopexit, label %B36.prol

B36.prol:
  %lsr.iv = phi i64 [ %lsr.iv.next, %B36.prol ], [ %xtraiter, %B36.preheader ]
  %.1043941.prol = phi i64 [ %.111.prol, %B36.prol ], [ %.1043941.ph, %B36.preheader ]
  %.111.prol = add nuw i64 %.1043941.prol, 1
  %20 = shl i64 %.1043941.prol, 3
  %scevgep72 = getelementptr i8, ptr %arg.x, i64 %20
  %.138.prol = load double, ptr %scevgep72, align 8
  %scevgep71 = getelementptr i8, ptr %arg.dx, i64 %20
  %.141.prol = load double, ptr %scevgep71, align 8
  %.143.prol = fmul double %arg.h, %.141.prol
  %.144.prol = fadd double %.138.prol, %.143.prol
  %scevgep54 = getelementptr i8, ptr %arg.out, i64 %20
  store double %.144.prol, ptr %scevgep54, align 8
  %lsr.iv.next = add nsw i64 %lsr.iv, -1
  %prol.iter.cmp.not = icmp eq i64 %lsr.iv.next, 0
  br i1 %prol.iter.cmp.not, label %B36.prol.loopexit, label %B36.prol, !llvm.loop !72

B36.prol.loopexit:
  %.1043941.unr = phi i64 [ %.1043941.ph, %B36.preheader ], [ %.111.prol, %B36.prol ]
  %21 = sub nsw i64 %.1043941.ph, %arg.size
  %22 = icmp ugt i64 %21, -8
  br i1 %22, label %B86, label %B36

B36:
  %.1043941 = phi i64 [ %.111.7, %B36 ], [ %.1043941.unr, %B36.prol.loopexit ]
  %sunkaddr116 = shl i64 %.1043941, 3
  %sunkaddr117 = getelementptr i8, ptr %arg.x, i64 %sunkaddr116
  %.138 = load double, ptr %sunkaddr117, align 8
  %sunkaddr119 = getelementptr i8, ptr %arg.dx, i64 %sunkaddr116
  %.141 = load double, ptr %sunkaddr119, align 8
  %.143 = fmul double %arg.h, %.141
  %.144 = fadd double %.138, %.143
  %sunkaddr121 = getelementptr i8, ptr %arg.out, i64 %sunkaddr116
  store double %.144, ptr %sunkaddr121, align 8
  %sunkaddr124 = getelementptr i8, ptr %sunkaddr117, i64 8
  %.138.1 = load double, ptr %sunkaddr124, align 8
  %sunkaddr127 = getelementptr i8, ptr %sunkaddr119, i64 8
  %.141.1 = load double, ptr %sunkaddr127, align 8
  %.143.1 = fmul double %arg.h, %.141.1
  %.144.1 = fadd double %.138.1, %.143.1
  %sunkaddr130 = getelementptr i8, ptr %sunkaddr121, i64 8
  store double %.144.1, ptr %sunkaddr130, align 8
  %sunkaddr133 = getelementptr i8, ptr %sunkaddr117, i64 16
  %.138.2 = load double, ptr %sunkaddr133, align 8
  %sunkaddr136 = getelementptr i8, ptr %sunkaddr119, i64 16
  %.141.2 = load double, ptr %sunkaddr136, align 8
  %.143.2 = fmul double %arg.h, %.141.2
  %.144.2 = fadd double %.138.2, %.143.2
  %sunkaddr139 = getelementptr i8, ptr %sunkaddr121, i64 16
  store double %.144.2, ptr %sunkaddr139, align 8
  %sunkaddr142 = getelementptr i8, ptr %sunkaddr117, i64 24
  %.138.3 = load double, ptr %sunkaddr142, align 8
  %sunkaddr145 = getelementptr i8, ptr %sunkaddr119, i64 24
  %.141.3 = load double, ptr %sunkaddr145, align 8
  %.143.3 = fmul double %arg.h, %.141.3
  %.144.3 = fadd double %.138.3, %.143.3
  %sunkaddr148 = getelementptr i8, ptr %sunkaddr121, i64 24
  store double %.144.3, ptr %sunkaddr148, align 8
  %sunkaddr151 = getelementptr i8, ptr %sunkaddr117, i64 32
  %.138.4 = load double, ptr %sunkaddr151, align 8
  %sunkaddr154 = getelementptr i8, ptr %sunkaddr119, i64 32
  %.141.4 = load double, ptr %sunkaddr154, align 8
  %.143.4 = fmul double %arg.h, %.141.4
  %.144.4 = fadd double %.138.4, %.143.4
  %sunkaddr157 = getelementptr i8, ptr %sunkaddr121, i64 32
  store double %.144.4, ptr %sunkaddr157, align 8
  %sunkaddr160 = getelementptr i8, ptr %sunkaddr117, i64 40
  %.138.5 = load double, ptr %sunkaddr160, align 8
  %sunkaddr163 = getelementptr i8, ptr %sunkaddr119, i64 40
  %.141.5 = load double, ptr %sunkaddr163, align 8
  %.143.5 = fmul double %arg.h, %.141.5
  %.144.5 = fadd double %.138.5, %.143.5
  %sunkaddr166 = getelementptr i8, ptr %sunkaddr121, i64 40
  store double %.144.5, ptr %sunkaddr166, align 8
  %sunkaddr169 = getelementptr i8, ptr %sunkaddr117, i64 48
  %.138.6 = load double, ptr %sunkaddr169, align 8
  %sunkaddr172 = getelementptr i8, ptr %sunkaddr119, i64 48
  %.141.6 = load double, ptr %sunkaddr172, align 8
  %.143.6 = fmul double %arg.h, %.141.6
  %.144.6 = fadd double %.138.6, %.143.6
  %sunkaddr175 = getelementptr i8, ptr %sunkaddr121, i64 48
  store double %.144.6, ptr %sunkaddr175, align 8
  %.111.7 = add nuw nsw i64 %.1043941, 8
  %sunkaddr178 = getelementptr i8, ptr %sunkaddr117, i64 56
  %.138.7 = load double, ptr %sunkaddr178, align 8
  %sunkaddr181 = getelementptr i8, ptr %sunkaddr119, i64 56
  %.141.7 = load double, ptr %sunkaddr181, align 8
  %.143.7 = fmul double %arg.h, %.141.7
  %.144.7 = fadd double %.138.7, %.143.7
  %sunkaddr184 = getelementptr i8, ptr %sunkaddr121, i64 56
  store double %.144.7, ptr %sunkaddr184, align 8
  %exitcond.not.7 = icmp eq i64 %arg.size, %.111.7
  br i1 %exitcond.not.7, label %B86, label %B36, !llvm.loop !73

B86:
  store ptr null, ptr %retptr, align 8
  ret i32 0
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels7rk4_sumB3v25B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ad10float64_2a10float64_2a10float64_2a10float64_2a10float64_2ax(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.x, double %arg.h, ptr readonly %arg.k1, ptr readonly %arg.k2, ptr readonly %arg.k3, ptr readonly %arg.k4, ptr writeonly %arg.out, i64 %arg.size) local_unnamed_addr #0 {
B0.endif:
  %.10741.not = icmp slt i64 %arg.size, 1
  br i1 %.10741.not, label %B156, label %iter.check

iter.check:
  %.168 = fdiv double %arg.h, 6.000000e+00
  %min.iters.check = icmp samesign ult i64 %arg.size, 4
  br i1 %min.iters.check, label %B36.endif.preheader, label %vector.memcheck

vector.memcheck:
  %0 = ptrtoint ptr %arg.out to i64
  %1 = ptrtoint ptr %arg.k1 to i64
  %2 = ptrtoint ptr %arg.k2 to i64
  %3 = ptrtoint ptr %arg.k3 to i64
  %4 = ptrtoint ptr %arg.k4 to i64
  %5 = ptrtoint ptr %arg.x to i64
  %6 = sub i64 %0, %1
  %diff.check = icmp ult i64 %6, 128
  %7 = sub i64 %0, %2
  %diff.check4 = icmp ult i64 %7, 128
  %conflict.rdx = or i1 %diff.check, %diff.check4
  %8 = sub i64 %0, %3
  %diff.check6 = icmp ult i64 %8, 128
  %conflict.rdx7 = or i1 %diff.check6, %conflict.rdx
  %9 = sub i64 %0, %4
  %diff.check9 = icmp ult i64 %9, 128
  %conflict.rdx10 = or i1 %diff.check9, %conflict.rdx7
  %10 = sub i64 %0, %5
  %diff.check12 = icmp ult i64 %10, 128
  %conflict.rdx13 = or i1 %diff.check12, %conflict.rdx10
  br i1 %conflict.rdx13, label %B36.endif.preheader, label %vector.main.loop.iter.check

vector.main.loop.iter.check:
  %min.iters.check14 = icmp samesign ult i64 %arg.size, 16
  br i1 %min.iters.check14, label %vector.main.loop.iter.check.vec.epilog.ph_crit_edge, label %vector.ph

vector.main.loop.iter.check.vec.epilog.ph_crit_edge:
  %.pre = insertelement <4 x double> poison, double %.168, i64 0
  %.pre1 = shufflevector <4 x double> %.pre, <4 x double> poison, <4 x i32> zeroinitializer
  br label %vec.epilog.ph

vector.ph:
  %n.vec = and i64 %arg.size, 9223372036854775792
  %broadcast.splatinsert = insertelement <4 x double> poison, double %.168, i64 0
  %broadcast.splat = shufflevector <4 x double> %broadcast.splatinsert, <4 x double> poison, <4 x i32> zeroinitializer
  br label %vector.body

vector.body:
  %index = phi i64 [ 0, %vector.ph ], [ %index.next, %vector.body ]
  %sunkaddr108 = shl i64 %index, 3
  %sunkaddr109 = getelementptr i8, ptr %arg.k1, i64 %sunkaddr108
  %wide.load = load <4 x double>, ptr %sunkaddr109, align 8
  %sunkaddr112 = getelementptr i8, ptr %sunkaddr109, i64 32
  %wide.load15 = load <4 x double>, ptr %sunkaddr112, align 8
  %sunkaddr115 = getelementptr i8, ptr %sunkaddr109, i64 64
  %wide.load16 = load <4 x double>, ptr %sunkaddr115, align 8
  %sunkaddr117 = getelementptr i8, ptr %sunkaddr109, i64 96
  %wide.load17 = load <4 x double>, ptr %sunkaddr117, align 8
  %sunkaddr119 = getelementptr i8, ptr %arg.k2, i64 %sunkaddr108
  %wide.load18 = load <4 x double>, ptr %sunkaddr119, align 8
  %sunkaddr122 = getelementptr i8, ptr %sunkaddr119, i64 32
  %wide.load19 = load <4 x double>, ptr %sunkaddr122, align 8
  %sunkaddr125 = getelementptr i8, ptr %sunkaddr119, i64 64
  %wide.load20 = load <4 x double>, ptr %sunkaddr125, align 8
  %sunkaddr128 = getelementptr i8, ptr %sunkaddr119, i64 96
  %wide.load21 = load <4 x double>, ptr %sunkaddr128, align 8
  %sunkaddr130 = getelementptr i8, ptr %arg.k3, i64 %sunkaddr108
  %wide.load22 = load <4 x double>, ptr %sunkaddr130, align 8
  %sunkaddr133 = getelementptr i8, ptr %sunkaddr130, i64 32
  %wide.load23 = load <4 x double>, ptr %sunkaddr133, align 8
  %sunkaddr136 = getelementptr i8, ptr %sunkaddr130, i64 64
  %wide.load24 = load <4 x double>, ptr %sunkaddr136, align 8
  %sunkaddr139 = getelementptr i8, ptr %sunkaddr130, i64 96
  %wide.load25 = load <4 x double>, ptr %sunkaddr139, align 8
  %11 = fadd <4 x double> %wide.load18, %wide.load22
  %12 = fadd <4 x double> %wide.load19, %wide.load23
  %13 = fadd <4 x double> %wide.load20, %wide.load24
  %14 = fadd <4 x double> %wide.load21, %wide.load25
  %15 = fmul <4 x double> %11, splat (double 2.000000e+00)
  %16 = fmul <4 x double> %12, splat (double 2.000000e+00)
  %17 = fmul <4 x double> %13, splat (double 2.000000e+00)
  %18 = fmul <4 x double> %14, splat (double 2.000000e+00)
  %19 = fadd <4 x double> %wide.load, %15
  %20 = fadd <4 x double> %wide.load15, %16
  %21 = fadd <4 x double> %wide.load16, %17
  %22 = fadd <4 x double> %wide.load17, %18
  %sunkaddr141 = getelementptr i8, ptr %arg.k4, i64 %sunkaddr108
  %wide.load26 = load <4 x double>, ptr %sunkaddr141, align 8
  %sunkaddr144 = getelementptr i8, ptr %sunkaddr141, i64 32
  %wide.load27 = load <4 x double>, ptr %sunkaddr144, align 8
  %sunkaddr147 = getelementptr i8, ptr %sunkaddr141, i64 64
  %wide.load28 = load <4 x double>, ptr %sunkaddr147, align 8
  %sunkaddr150 = getelementptr i8, ptr %sunkaddr141, i64 96
  %wide.load29 = load <4 x double>, ptr %sunkaddr150, align 8
  %23 = fadd <4 x double> %19, %wide.load26
  %24 = fadd <4 x double> %20, %wide.load27
  %25 = fadd <4 x double> %21, %wide.load28
  %26 = fadd <4 x double> %22, %wide.load29
  %sunkaddr152 = getelementptr i8, ptr %arg.x, i64 %sunkaddr108
  %wide.load30 = load <4 x double>, ptr %sunkaddr152, align 8
  %sunkaddr155 = getelementptr i8, ptr %sunkaddr152, i64 32
  %wide.load31 = load <4 x double>, ptr %sunkaddr155, align 8
  %sunkaddr158 = getelementptr i8, ptr %sunkaddr152, i64 64
  %wide.load32 = load <4 x double>, ptr %sunkaddr158, align 8
  %sunkaddr161 = getelementptr i8, ptr %sunkaddr152, i64 96
  %wide.load33 = load <4 x double>, ptr %sunkaddr161, align 8
  %27 = fmul <4 x double> %broadcast.splat, %23
  %28 = fmul <4 x double> %broadcast.splat, %24
  %29 = fmul <4 x double> %broadcast.splat, %25
  %30 = fmul <4 x double> %broadcast.splat, %26
  %31 = fadd <4 x double> %27, %wide.load30
  %32 = fadd <4 x double> %28, %wide.load31
  %33 = fadd <4 x double> %29, %wide.load32
  %34 = fadd <4 x double> %30, %wide.load33
  %sunkaddr163 = getelementptr i8, ptr %arg.out, i64 %sunkaddr108
  store <4 x double> %31, ptr %sunkaddr163, align 8
  %sunkaddr166 = getelementptr i8, ptr %sunkaddr163, i64 32
  store <4 x double> %32, ptr %sunkaddr166, align 8
  %sunkaddr169 = getelementptr i8, ptr %sunkaddr163, i64 64
  store <4 x double> %33, ptr %sunkaddr169, align 8
  %sunkaddr172 = getelementptr i8, ptr %sunkaddr163, i64 96
  store <4 x double> %34, ptr %sunkaddr172, align 8
  %index.next = add nuw nsw i64 %index, 16
  %35 = icmp eq i64 %n.vec, %index.next
  br i1 %35, label %middle.block, label %vector.body, !llvm.loop !74

middle.block:
  %cmp.n = icmp eq i64 %arg.size, %n.vec
  br i1 %cmp.n, label %B156, label %vec.epilog.iter.check

vec.epilog.iter.check:
  %36 = and i64 %arg.size, 12
  %min.epilog.iters.check = icmp eq i64 %36, 0
  br i1 %min.epilog.iters.check, label %B36.endif.preheader, label %vec.epilog.ph, !prof !20

vec.epilog.ph:
  %broadcast.splat37.pre-phi = phi <4 x double> [ %.pre1, %vector.main.loop.iter.check.vec.epilog.ph_crit_edge ], [ %broadcast.splat, %vec.epilog.iter.check ]
  %vec.epilog.resume.val = phi i64 [ 0, %vector.main.loop.iter.check.vec.epilog.ph_crit_edge ], [ %n.vec, %vec.epilog.iter.check ]
  %n.vec35 = and i64 %arg.size, 9223372036854775804
  br label %vec.epilog.vector.body

vec.epilog.vector.body:
  %index38 = phi i64 [ %vec.epilog.resume.val, %vec.epilog.ph ], [ %index.next44, %vec.epilog.vector.body ]
  %37 = shl i64 %index38, 3
  %scevgep111 = getelementptr i8, ptr %arg.k1, i64 %37
  %wide.load39 = load <4 x double>, ptr %scevgep111, align 8
  %scevgep110 = getelementptr i8, ptr %arg.k2, i64 %37
  %wide.load40 = load <4 x double>, ptr %scevgep110, align 8
  %scevgep109 = getelementptr i8, ptr %arg.k3, i64 %37
  %wide.load41 = load <4 x double>, ptr %scevgep109, align 8
  %38 = fadd <4 x double> %wide.load40, %wide.load41
  %39 = fmul <4 x double> %38, splat (double 2.000000e+00)
  %40 = fadd <4 x double> %wide.load39, %39
  %scevgep44 = getelementptr i8, ptr %arg.k4, i64 %37
  %wide.load42 = load <4 x double>, ptr %scevgep44, align 8
  %41 = fadd <4 x double> %wide.load42, %40
  %scevgep43 = getelementptr i8, ptr %arg.x, i64 %37
  %wide.load43 = load <4 x double>, ptr %scevgep43, align 8
  %42 = fmul <4 x double> %broadcast.splat37.pre-phi, %41
  %43 = fadd <4 x double> %wide.load43, %42
  %scevgep42 = getelementptr i8, ptr %arg.out, i64 %37
  store <4 x double> %43, ptr %scevgep42, align 8
  %index.next44 = add nuw i64 %index38, 4
  %44 = icmp eq i64 %n.vec35, %index.next44
  br i1 %44, label %vec.epilog.middle.block, label %vec.epilog.vector.body, !llvm.loop !75

vec.epilog.middle.block:
  %cmp.n45 = icmp eq i64 %arg.size, %n.vec35
  br i1 %cmp.n45, label %B156, label %B36.endif.preheader

B36.endif.preheader:
  %.1134042.ph = phi i64 [ 0, %iter.check ], [ 0, %vector.memcheck ], [ %n.vec, %vec.epilog.iter.check ], [ %n.vec35, %vec.epilog.middle.block ]
  %xtraiter = and i64 %arg.size, 3
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B36.endif.prol.loopexit, label %B36.endif.prol.preheader

B36.endif.prol.preheader:
  %45 = shl i64 %.1134042.ph, 3
  %scevgep94 = getelementptr i8, ptr %arg.out, i64 %45
  %scevgep96 = getelementptr i8, ptr %arg.x, i64 %45
  %scevgep98 = getelementptr i8, ptr %arg.k4, i64 %45
  %scevgep100 = getelementptr i8, ptr %arg.k3, i64 %45
  %scevgep102 = getelementptr i8, ptr %arg.k2, i64 %45
  %scevgep104 = getelementptr i8, ptr %arg.k1, i64 %45
  %46 = shl nuw nsw i64 %xtraiter, 3
  br label %B36.endif.prol

B36.endif.prol:
  %lsr.iv34 = phi i64 [ %lsr.iv.next35, %B36.endif.prol ], [ 0, %B36.endif.prol.preheader ]
  %scevgep41 = getelementptr i8, ptr %scevgep104, i64 %lsr.iv34
  %.147.prol = load double, ptr %scevgep41, align 8
  %scevgep40 = getelementptr i8, ptr %scevgep102, i64 %lsr.iv34
  %.150.prol = load double, ptr %scevgep40, align 8
  %scevgep39 = getelementptr i8, ptr %scevgep100, i64 %lsr.iv34
  %.153.prol = load double, ptr %scevgep39, align 8
  %.154.prol = fadd double %.150.prol, %.153.prol
  %.155.prol = fmul double %.154.prol, 2.000000e+00
  %.156.prol = fadd double %.147.prol, %.155.prol
  %scevgep38 = getelementptr i8, ptr %scevgep98, i64 %lsr.iv34
  %.159.prol = load double, ptr %scevgep38, align 8
  %.160.prol = fadd double %.159.prol, %.156.prol
  %scevgep37 = getelementptr i8, ptr %scevgep96, i64 %lsr.iv34
  %.163.prol = load double, ptr %scevgep37, align 8
  %.169.prol = fmul double %.168, %.160.prol
  %.170.prol = fadd double %.163.prol, %.169.prol
  %scevgep36 = getelementptr i8, ptr %scevgep94, i64 %lsr.iv34
  store double %.170.prol, ptr %scevgep36, align 8
  %lsr.iv.next35 = add nuw nsw i64 %lsr.iv34, 8
  %prol.iter.cmp.not = icmp eq i64 %46, %lsr.iv.next35
  br i1 %prol.iter.cmp.not, label %B36.endif.prol.loopexit.loopexit, label %B36.endif.prol, !llvm.loop !76

B36.endif.prol.loopexit.loopexit:
  %47 = or disjoint i64 %.1134042.ph, %xtraiter
  br label %B36.endif.prol.loopexit

B36.endif.prol.loopexit:
  %.1134042.unr = phi i64 [ %.1134042.ph, %B36.endif.preheader ], [ %47, %B36.endif.prol.loopexit.loopexit ]
  %48 = sub nsw i64 %.1134042.ph, %arg.size
  %49 = icmp ugt i64 %48, -4
  br i1 %49, label %B156, label %B36.endif.preheader46

B36.endif.preheader46:
  %50 = shl i64 %.1134042.unr, 3
  %51 = add i64 %50, 24
  %scevgep = getelementptr i8, ptr %arg.out, i64 %51
  %scevgep54 = getelementptr i8, ptr %arg.x, i64 %51
  %scevgep62 = getelementptr i8, ptr %arg.k4, i64 %51
  %scevgep70 = getelementptr i8, ptr %arg.k3, i64 %51
  %scevgep78 = getelementptr i8, ptr %arg.k2, i64 %51
  %scevgep86 = getelementptr i8, ptr %arg.k1, i64 %51
  %.neg = and i64 %arg.size, 9223372036854775804
  %52 = sub nsw i64 %.neg, %.1134042.ph
  br label %B36.endif

B156:
  store ptr null, ptr %retptr, align 8
  ret i32 0

B36.endif:
  %lsr.iv = phi i64 [ 0, %B36.endif.preheader46 ], [ %lsr.iv.next, %B36.endif ]
  %53 = shl i64 %lsr.iv, 3
  %scevgep90 = getelementptr i8, ptr %scevgep86, i64 %53
  %scevgep91 = getelementptr i8, ptr %scevgep90, i64 -24
  %.147 = load double, ptr %scevgep91, align 8
  %scevgep82 = getelementptr i8, ptr %scevgep78, i64 %53
  %scevgep83 = getelementptr i8, ptr %scevgep82, i64 -24
  %.150 = load double, ptr %scevgep83, align 8
  %scevgep20 = getelementptr i8, ptr %scevgep70, i64 %53
  %scevgep25 = getelementptr i8, ptr %scevgep20, i64 -24
  %.153 = load double, ptr %scevgep25, align 8
  %.154 = fadd double %.150, %.153
  %.155 = fmul double %.154, 2.000000e+00
  %.156 = fadd double %.147, %.155
  %scevgep14 = getelementptr i8, ptr %scevgep62, i64 %53
  %scevgep19 = getelementptr i8, ptr %scevgep14, i64 -24
  %.159 = load double, ptr %scevgep19, align 8
  %.160 = fadd double %.159, %.156
  %scevgep8 = getelementptr i8, ptr %scevgep54, i64 %53
  %scevgep13 = getelementptr i8, ptr %scevgep8, i64 -24
  %.163 = load double, ptr %scevgep13, align 8
  %.169 = fmul double %.168, %.160
  %.170 = fadd double %.163, %.169
  %scevgep2 = getelementptr i8, ptr %scevgep, i64 %53
  %scevgep7 = getelementptr i8, ptr %scevgep2, i64 -24
  store double %.170, ptr %scevgep7, align 8
  %scevgep33 = getelementptr i8, ptr %scevgep90, i64 -16
  %.147.1 = load double, ptr %scevgep33, align 8
  %scevgep29 = getelementptr i8, ptr %scevgep82, i64 -16
  %.150.1 = load double, ptr %scevgep29, align 8
  %scevgep24 = getelementptr i8, ptr %scevgep20, i64 -16
  %.153.1 = load double, ptr %scevgep24, align 8
  %.154.1 = fadd double %.150.1, %.153.1
  %.155.1 = fmul double %.154.1, 2.000000e+00
  %.156.1 = fadd double %.147.1, %.155.1
  %scevgep18 = getelementptr i8, ptr %scevgep14, i64 -16
  %.159.1 = load double, ptr %scevgep18, align 8
  %.160.1 = fadd double %.159.1, %.156.1
  %scevgep12 = getelementptr i8, ptr %scevgep8, i64 -16
  %.163.1 = load double, ptr %scevgep12, align 8
  %.169.1 = fmul double %.168, %.160.1
  %.170.1 = fadd double %.163.1, %.169.1
  %scevgep6 = getelementptr i8, ptr %scevgep2, i64 -16
  store double %.170.1, ptr %scevgep6, align 8
  %scevgep31 = getelementptr i8, ptr %scevgep90, i64 -8
  %.147.2 = load double, ptr %scevgep31, align 8
  %scevgep27 = getelementptr i8, ptr %scevgep82, i64 -8
  %.150.2 = load double, ptr %scevgep27, align 8
  %scevgep22 = getelementptr i8, ptr %scevgep20, i64 -8
  %.153.2 = load double, ptr %scevgep22, align 8
  %.154.2 = fadd double %.150.2, %.153.2
  %.155.2 = fmul double %.154.2, 2.000000e+00
  %.156.2 = fadd double %.147.2, %.155.2
  %scevgep16 = getelementptr i8, ptr %scevgep14, i64 -8
  %.159.2 = load double, ptr %scevgep16, align 8
  %.160.2 = fadd double %.159.2, %.156.2
  %scevgep10 = getelementptr i8, ptr %scevgep8, i64 -8
  %.163.2 = load double, ptr %scevgep10, align 8
  %.169.2 = fmul double %.168, %.160.2
  %.170.2 = fadd double %.163.2, %.169.2
  %scevgep4 = getelementptr i8, ptr %scevgep2, i64 -8
  store double %.170.2, ptr %scevgep4, align 8
  %.147.3 = load double, ptr %scevgep90, align 8
  %.150.3 = load double, ptr %scevgep82, align 8
  %.153.3 = load double, ptr %scevgep20, align 8
  %.154.3 = fadd double %.150.3, %.153.3
  %.155.3 = fmul double %.154.3, 2.000000e+00
  %.156.3 = fadd double %.147.3, %.155.3
  %.159.3 = load double, ptr %scevgep14, align 8
  %.160.3 = fadd double %.159.3, %.156.3
  %.163.3 = load double, ptr %scevgep8, align 8
  %.169.3 = fmul double %.168, %.160.3
  %.170.3 = fadd double %.163.3, %.169.3
  store double %.170.3, ptr %scevgep2, align 8
  %lsr.iv.next = add i64 %lsr.iv, 4
  %exitcond.not.3 = icmp eq i64 %52, %lsr.iv.next
  br i1 %exitcond.not.3, label %B156, label %B36.endif, !llvm.loop !77
}


define ptr @classical(ptr %.1, double %.2, ptr %.3, ptr readonly %.4, double %.5, ptr writeonly %.6) local_unnamed_addr #0 {
entry:
  %.8 = alloca ptr, align 8
  store ptr null, ptr %.8, align 8
  %excinfo = alloca ptr, align 8
  %.12 = call i32 @_ZN18biped_adrc_kernels9classicalB3v24B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad10float64_2a10float64_2ad10float64_2a(ptr nonnull %.8, ptr nonnull %excinfo, ptr %.1, double %.2, ptr %.3, ptr %.4, double %.5, ptr %.6) #0
  %cond = icmp eq i32 %.12, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.22 = load ptr, ptr %.8, align 8
  ret ptr %.22
}

define i32 @_ZN18biped_adrc_kernels11exponentialB3v26B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axdd10float64_2a10float64_2a10float64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r, i64 %arg.level, double %arg.t, double %arg.h, ptr %arg.y, ptr readonly %arg.N, ptr %arg.out) local_unnamed_addr {
B0.endif.endif.endif.endif:
  %.138 = alloca ptr, align 8
  %excinfo.5 = alloca ptr, align 8
  %.168 = alloca ptr, align 8
  %excinfo.6 = alloca ptr, align 8
  %.194 = alloca ptr, align 8
  %excinfo.7 = alloca ptr, align 8
  %.219 = alloca ptr, align 8
  %excinfo.8 = alloca ptr, align 8
  %.254 = alloca ptr, align 8
  %excinfo.9 = alloca ptr, align 8
  %.282 = alloca ptr, align 8
  %excinfo.10 = alloca ptr, align 8
  %.341 = alloca ptr, align 8
  %excinfo.12 = alloca ptr, align 8
  %.369 = alloca ptr, align 8
  %excinfo.13 = alloca ptr, align 8
  %.394 = alloca ptr, align 8
  %excinfo.14 = alloca ptr, align 8
  %.499 = alloca ptr, align 8
  %excinfo.18 = alloca ptr, align 8
  %.527 = alloca ptr, align 8
  %excinfo.19 = alloca ptr, align 8
  %.555 = alloca ptr, align 8
  %excinfo.20 = alloca ptr, align 8
  %.608 = alloca ptr, align 8
  %excinfo.22 = alloca ptr, align 8
  %.642 = alloca ptr, align 8
  %excinfo.23 = alloca ptr, align 8
  %.7.i = getelementptr i8, ptr %arg.r, i64 304
  %.8.i = load i64, ptr %.7.i, align 8, !noalias !78
  %.9.i = inttoptr i64 %.8.i to ptr
  %.10.i = mul nsw i64 %arg.level, 6
  %.12.i = getelementptr i8, ptr %arg.r, i64 112
  %.13.i = load i64, ptr %.12.i, align 8, !noalias !78
  %.14.i = mul i64 %.13.i, %.13.i
  %.17.i = mul i64 %.14.i, %.10.i
  %.18.i = getelementptr double, ptr %.9.i, i64 %.17.i
  %.11.i = or disjoint i64 %.10.i, 1
  %.17.i8 = mul i64 %.14.i, %.11.i
  %.18.i9 = getelementptr double, ptr %.9.i, i64 %.17.i8
  %.11.i14 = add nsw i64 %.10.i, 4
  %.17.i18 = mul i64 %.14.i, %.11.i14
  %.18.i19 = getelementptr double, ptr %.9.i, i64 %.17.i18
  %.88 = getelementptr i8, ptr %arg.r, i64 816
  %.89 = load i64, ptr %.88, align 8
  %.90 = inttoptr i64 %.89 to ptr
  %.91 = getelementptr i8, ptr %arg.r, i64 824
  %.92 = load i64, ptr %.91, align 8
  %.94 = getelementptr i8, ptr %arg.r, i64 104
  %.95 = load i64, ptr %.94, align 8
  %.105 = getelementptr i8, ptr %arg.r, i64 832
  %.106 = load i64, ptr %.105, align 8
  %.107 = inttoptr i64 %.106 to ptr
  %.8.i20 = getelementptr i8, ptr %arg.r, i64 56
  %.9.i21 = load i64, ptr %.8.i20, align 8, !noalias !81
  %.12.i24 = getelementptr double, ptr %arg.y, i64 %.95
  %.15.i = getelementptr double, ptr %.107, i64 %.95
  %.16.i = inttoptr i64 %.9.i21 to ptr
  tail call void %.16.i(ptr %.18.i, ptr %.12.i24, ptr %.15.i), !noalias !81
  %.134 = load i64, ptr %.105, align 8
  %.135 = inttoptr i64 %.134 to ptr
  %.136 = getelementptr i8, ptr %arg.r, i64 80
  %.137 = load i64, ptr %.136, align 8
  %.142 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.138, ptr nonnull %excinfo.5, ptr %.135, ptr %.90, i64 %.137)
  switch i32 %.142, label %common.ret [
    i32 -2, label %B0.endif.endif.endif.endif.endif
    i32 0, label %B0.endif.endif.endif.endif.endif
  ], !prof !8

common.ret:
  %excinfo.sink = phi ptr [ %excinfo, %B0.endif.endif.endif.endi...endif.4.if.if ], [ %excinfo, %B0.endif.endif.endif.endi...endif.3.endif.endif.endif ], [ %excinfo, %B0.endif.endif.endif.endi...endif.3.endif ], [ %excinfo, %B0.endif.endif.endif.endi...endif.3 ], [ %excinfo, %B0.endif.endif.endif.endi...endif.2.endif.endif.endif ], [ %excinfo, %B0.endif.endif.endif.endi...endif.1.endif.endif.endif ], [ %excinfo, %B0.endif.endif.endif.endi...endif.1.endif.endif ], [ %excinfo, %B0.endif.endif.endif.endi...endif.1.endif ], [ %excinfo, %B0.endif.endif.endif.endif.endif.endif.endif.endif.endif ], [ %excinfo, %B0.endif.endif.endif.endif.endif.endif.endif.endif ], [ %excinfo, %B0.endif.endif.endif.endif.endif.endif.endif ], [ %excinfo, %B0.endif.endif.endif.endif.endif.endif ], [ %excinfo, %B0.endif.endif.endif.endif.endif ], [ %excinfo, %B0.endif.endif.endif.endif ], [ %retptr, %B0.endif.endif.endif.endi...endif.4 ], [ %retptr, %B0.endif.endif.endif.endi...endif.4 ]
  %common.ret.op = phi i32 [ %.646, %B0.endif.endif.endif.endi...endif.4.if.if ], [ %.612, %B0.endif.endif.endif.endi...endif.3.endif.endif.endif ], [ %.559, %B0.endif.endif.endif.endi...endif.3.endif ], [ %.531, %B0.endif.endif.endif.endi...endif.3 ], [ %.503, %B0.endif.endif.endif.endi...endif.2.endif.endif.endif ], [ %.398, %B0.endif.endif.endif.endi...endif.1.endif.endif.endif ], [ %.373, %B0.endif.endif.endif.endi...endif.1.endif.endif ], [ %.345, %B0.endif.endif.endif.endi...endif.1.endif ], [ %.286, %B0.endif.endif.endif.endif.endif.endif.endif.endif.endif ], [ %.258, %B0.endif.endif.endif.endif.endif.endif.endif.endif ], [ %.223, %B0.endif.endif.endif.endif.endif.endif.endif ], [ %.198, %B0.endif.endif.endif.endif.endif.endif ], [ %.172, %B0.endif.endif.endif.endif.endif ], [ %.142, %B0.endif.endif.endif.endif ], [ 0, %B0.endif.endif.endif.endi...endif.4 ], [ 0, %B0.endif.endif.endif.endi...endif.4 ]
  store ptr null, ptr %excinfo.sink, align 8
  ret i32 %common.ret.op

B0.endif.endif.endif.endif.endif:
  %0 = inttoptr i64 %.92 to ptr
  %.164 = load i64, ptr %.105, align 8
  %.165 = inttoptr i64 %.164 to ptr
  %.167 = load i64, ptr %.136, align 8
  %.172 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.168, ptr nonnull %excinfo.6, ptr %.165, ptr %0, i64 %.167)
  switch i32 %.172, label %common.ret [
    i32 -2, label %B0.endif.endif.endif.endif.endif.endif
    i32 0, label %B0.endif.endif.endif.endif.endif.endif
  ], !prof !8

B0.endif.endif.endif.endif.endif.endif:
  %.193 = fmul double %arg.h, 5.000000e-01
  %.198 = call i32 @_ZN18biped_adrc_kernels3addB2v2B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ad10float64_2a10float64_2ax(ptr nonnull %.194, ptr nonnull %excinfo.7, ptr %arg.y, double %.193, ptr %arg.N, ptr %.90, i64 %.95)
  switch i32 %.198, label %common.ret [
    i32 -2, label %B0.endif.endif.endif.endif.endif.endif.endif
    i32 0, label %B0.endif.endif.endif.endif.endif.endif.endif
  ], !prof !8

B0.endif.endif.endif.endif.endif.endif.endif:
  %.223 = call i32 @_ZN18biped_adrc_kernels11apply_inputB3v31B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a10float64_2a(ptr nonnull %.219, ptr nonnull %excinfo.8, ptr nonnull %arg.r, ptr %.18.i9, double 1.000000e+00, ptr %arg.N, ptr %.90)
  switch i32 %.223, label %common.ret [
    i32 -2, label %B0.endif.endif.endif.endif.endif.endif.endif.endif
    i32 0, label %B0.endif.endif.endif.endif.endif.endif.endif.endif
  ], !prof !8

B0.endif.endif.endif.endif.endif.endif.endif.endif:
  %.244 = fadd double %arg.t, %.193
  %.245 = getelementptr i8, ptr %arg.r, i64 872
  %.246 = load i64, ptr %.245, align 8
  %.247 = inttoptr i64 %.246 to ptr
  %.248 = tail call ptr @remainder(ptr nonnull %arg.r, double %.244, ptr %.90, ptr %.247)
  %.252 = load i64, ptr %.245, align 8
  %.253 = inttoptr i64 %.252 to ptr
  %.258 = call i32 @_ZN18biped_adrc_kernels3addB2v2B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ad10float64_2a10float64_2ax(ptr nonnull %.254, ptr nonnull %excinfo.9, ptr %arg.y, double %.193, ptr %.253, ptr %0, i64 %.95)
  switch i32 %.258, label %common.ret [
    i32 -2, label %B0.endif.endif.endif.endif.endif.endif.endif.endif.endif
    i32 0, label %B0.endif.endif.endif.endif.endif.endif.endif.endif.endif
  ], !prof !8

B0.endif.endif.endif.endif.endif.endif.endif.endif.endif:
  %.280 = load i64, ptr %.245, align 8
  %.281 = inttoptr i64 %.280 to ptr
  %.286 = call i32 @_ZN18biped_adrc_kernels11apply_inputB3v31B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a10float64_2a(ptr nonnull %.282, ptr nonnull %excinfo.10, ptr nonnull %arg.r, ptr %.18.i9, double 1.000000e+00, ptr %.281, ptr %0)
  switch i32 %.286, label %common.ret [
    i32 -2, label %B0.endif.endif.endif.endi...endif.1.endif
    i32 0, label %B0.endif.endif.endif.endi...endif.1.endif
  ], !prof !8

B0.endif.endif.endif.endi...endif.1.endif:
  %.308 = getelementptr i8, ptr %arg.r, i64 880
  %.309 = load i64, ptr %.308, align 8
  %.310 = inttoptr i64 %.309 to ptr
  %.311 = tail call ptr @remainder(ptr nonnull %arg.r, double %.244, ptr %0, ptr %.310)
  %.9.i26 = load i64, ptr %.8.i20, align 8, !noalias !84
  %.11.i28 = load i64, ptr %.94, align 8, !noalias !84
  %.12.i29 = getelementptr double, ptr %.90, i64 %.11.i28
  %.15.i30 = getelementptr double, ptr %0, i64 %.11.i28
  %.16.i31 = inttoptr i64 %.9.i26 to ptr
  tail call void %.16.i31(ptr %.18.i, ptr %.12.i29, ptr %.15.i30), !noalias !84
  %.339 = load i64, ptr %.308, align 8
  %.340 = inttoptr i64 %.339 to ptr
  %.345 = call i32 @_ZN18biped_adrc_kernels3addB2v2B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ad10float64_2a10float64_2ax(ptr nonnull %.341, ptr nonnull %excinfo.12, ptr %arg.y, double %arg.h, ptr %.340, ptr %0, i64 %.95)
  switch i32 %.345, label %common.ret [
    i32 -2, label %B0.endif.endif.endif.endi...endif.1.endif.endif
    i32 0, label %B0.endif.endif.endif.endi...endif.1.endif.endif
  ], !prof !8

B0.endif.endif.endif.endi...endif.1.endif.endif:
  %.367 = load i64, ptr %.308, align 8
  %.368 = inttoptr i64 %.367 to ptr
  %.373 = call i32 @_ZN18biped_adrc_kernels11apply_inputB3v31B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a10float64_2a(ptr nonnull %.369, ptr nonnull %excinfo.13, ptr nonnull %arg.r, ptr %.18.i9, double 2.000000e+00, ptr %.368, ptr %0)
  switch i32 %.373, label %common.ret [
    i32 -2, label %B0.endif.endif.endif.endi...endif.1.endif.endif.endif
    i32 0, label %B0.endif.endif.endif.endi...endif.1.endif.endif.endif
  ], !prof !8

B0.endif.endif.endif.endi...endif.1.endif.endif.endif:
  %.398 = call i32 @_ZN18biped_adrc_kernels11apply_inputB3v31B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a10float64_2a(ptr nonnull %.394, ptr nonnull %excinfo.14, ptr nonnull %arg.r, ptr %.18.i9, double -1.000000e+00, ptr %arg.N, ptr %0)
  switch i32 %.398, label %common.ret [
    i32 -2, label %B0.endif.endif.endif.endi...endif.2.endif.endif.endif
    i32 0, label %B0.endif.endif.endif.endi...endif.2.endif.endif.endif
  ], !prof !8

B0.endif.endif.endif.endi...endif.2.endif.endif.endif:
  %.418 = fadd double %arg.t, %arg.h
  %.419 = getelementptr i8, ptr %arg.r, i64 888
  %.420 = load i64, ptr %.419, align 8
  %.421 = inttoptr i64 %.420 to ptr
  %.422 = tail call ptr @remainder(ptr nonnull %arg.r, double %.418, ptr %0, ptr %.421)
  %.8.i33 = load i64, ptr %.7.i, align 8, !noalias !87
  %.9.i34 = inttoptr i64 %.8.i33 to ptr
  %.11.i36 = add nsw i64 %.10.i, 2
  %.13.i38 = load i64, ptr %.12.i, align 8, !noalias !87
  %.14.i39 = mul nsw i64 %.13.i38, %.11.i36
  %.17.i40 = mul nsw i64 %.14.i39, %.13.i38
  %.18.i41 = getelementptr double, ptr %.9.i34, i64 %.17.i40
  %.9.i43 = load i64, ptr %.8.i20, align 8, !noalias !90
  %.11.i45 = load i64, ptr %.94, align 8, !noalias !90
  %.12.i46 = getelementptr double, ptr %arg.y, i64 %.11.i45
  %.15.i47 = getelementptr double, ptr %arg.out, i64 %.11.i45
  %.16.i48 = inttoptr i64 %.9.i43 to ptr
  tail call void %.16.i48(ptr %.18.i41, ptr %.12.i46, ptr %.15.i47), !noalias !90
  %.8.i50 = load i64, ptr %.7.i, align 8, !noalias !93
  %.9.i51 = inttoptr i64 %.8.i50 to ptr
  %.11.i53 = add nsw i64 %.10.i, 3
  %.13.i55 = load i64, ptr %.12.i, align 8, !noalias !93
  %.14.i56 = mul nsw i64 %.13.i55, %.11.i53
  %.17.i57 = mul nsw i64 %.14.i56, %.13.i55
  %.18.i58 = getelementptr double, ptr %.9.i51, i64 %.17.i57
  %.503 = call i32 @_ZN18biped_adrc_kernels11apply_inputB3v31B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a10float64_2a(ptr nonnull %.499, ptr nonnull %excinfo.18, ptr nonnull %arg.r, ptr %.18.i58, double 1.000000e+00, ptr %arg.N, ptr %arg.out)
  switch i32 %.503, label %common.ret [
    i32 -2, label %B0.endif.endif.endif.endi...endif.3
    i32 0, label %B0.endif.endif.endif.endi...endif.3
  ], !prof !8

B0.endif.endif.endif.endi...endif.3:
  %.525 = load i64, ptr %.245, align 8
  %.526 = inttoptr i64 %.525 to ptr
  %.531 = call i32 @_ZN18biped_adrc_kernels11apply_inputB3v31B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a10float64_2a(ptr nonnull %.527, ptr nonnull %excinfo.19, ptr nonnull %arg.r, ptr %.18.i19, double 1.000000e+00, ptr %.526, ptr %arg.out)
  switch i32 %.531, label %common.ret [
    i32 -2, label %B0.endif.endif.endif.endi...endif.3.endif
    i32 0, label %B0.endif.endif.endif.endi...endif.3.endif
  ], !prof !8

B0.endif.endif.endif.endi...endif.3.endif:
  %.553 = load i64, ptr %.308, align 8
  %.554 = inttoptr i64 %.553 to ptr
  %.559 = call i32 @_ZN18biped_adrc_kernels11apply_inputB3v31B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a10float64_2a(ptr nonnull %.555, ptr nonnull %excinfo.20, ptr nonnull %arg.r, ptr %.18.i19, double 1.000000e+00, ptr %.554, ptr %arg.out)
  switch i32 %.559, label %common.ret [
    i32 -2, label %B0.endif.endif.endif.endi...endif.3.endif.endif.endif
    i32 0, label %B0.endif.endif.endif.endi...endif.3.endif.endif.endif
  ], !prof !8

B0.endif.endif.endif.endi...endif.3.endif.endif.endif:
  %.8.i60 = load i64, ptr %.7.i, align 8, !noalias !96
  %.9.i61 = inttoptr i64 %.8.i60 to ptr
  %.11.i63 = add nsw i64 %.10.i, 5
  %.13.i65 = load i64, ptr %.12.i, align 8, !noalias !96
  %.14.i66 = mul nsw i64 %.13.i65, %.11.i63
  %.17.i67 = mul nsw i64 %.14.i66, %.13.i65
  %.18.i68 = getelementptr double, ptr %.9.i61, i64 %.17.i67
  %.606 = load i64, ptr %.419, align 8
  %.607 = inttoptr i64 %.606 to ptr
  %.612 = call i32 @_ZN18biped_adrc_kernels11apply_inputB3v31B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a10float64_2a(ptr nonnull %.608, ptr nonnull %excinfo.22, ptr nonnull %arg.r, ptr %.18.i68, double 1.000000e+00, ptr %.607, ptr %arg.out)
  switch i32 %.612, label %common.ret [
    i32 -2, label %B0.endif.endif.endif.endi...endif.4
    i32 0, label %B0.endif.endif.endif.endi...endif.4
  ], !prof !8

B0.endif.endif.endif.endi...endif.4:
  %.634 = load i64, ptr %.245, align 8
  %.635 = inttoptr i64 %.634 to ptr
  %.637 = load i64, ptr %.308, align 8
  %.638 = inttoptr i64 %.637 to ptr
  %.640 = load i64, ptr %.419, align 8
  %.641 = inttoptr i64 %.640 to ptr
  %.646 = call i32 @_ZN18biped_adrc_kernels7rk4_sumB3v25B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ad10float64_2a10float64_2a10float64_2a10float64_2a10float64_2ax(ptr nonnull %.642, ptr nonnull %excinfo.23, ptr %arg.y, double %arg.h, ptr %arg.N, ptr %.635, ptr %.638, ptr %.641, ptr %arg.out, i64 %.95)
  switch i32 %.646, label %B0.endif.endif.endif.endi...endif.4.if.if [
    i32 -2, label %common.ret
    i32 0, label %common.ret
  ], !prof !8

B0.endif.endif.endif.endi...endif.4.if.if:
  br label %common.ret
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels11apply_inputB3v31B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad10float64_2a10float64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.r, ptr readonly %arg.M, double %arg.factor, ptr readonly %arg.N, ptr %arg.out) local_unnamed_addr #0 {
B0.endif:
  %.20 = getelementptr i8, ptr %arg.r, i64 112
  %.21 = load i64, ptr %.20, align 8
  %.10392.not = icmp slt i64 %.21, 1
  br i1 %.10392.not, label %B244, label %B46.endif.lr.ph

B46.endif.lr.ph:
  %.159 = getelementptr i8, ptr %arg.r, i64 88
  %0 = load i64, ptr %.159, align 8
  %1 = icmp slt i64 %0, 1
  br i1 %1, label %B244, label %B46.endif.preheader

B46.endif.preheader:
  %sunkaddr90 = getelementptr i8, ptr %arg.r, i64 104
  br label %B46.endif

B44.loopexit.loopexit.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B44.loopexit, label %B134.epil.preheader

B134.epil.preheader:
  %.2468183.epil.init = phi i64 [ 0, %B134.preheader ], [ %unroll_iter, %B44.loopexit.loopexit.unr-lcssa ]
  %2 = shl i64 %.2468183.epil.init, 3
  %scevgep48 = getelementptr i8, ptr %arg.N, i64 %2
  %scevgep52 = getelementptr i8, ptr %arg.out, i64 %2
  br label %B134.epil

B134.epil:
  %lsr.iv56 = phi i64 [ %lsr.iv.next57, %B134.epil ], [ %xtraiter, %B134.epil.preheader ]
  %lsr.iv53 = phi ptr [ %scevgep54, %B134.epil ], [ %scevgep52, %B134.epil.preheader ]
  %lsr.iv49 = phi ptr [ %scevgep50, %B134.epil ], [ %scevgep48, %B134.epil.preheader ]
  %.280.epil = load i64, ptr %sunkaddr90, align 8
  %.283.epil = load i64, ptr %.159, align 8
  %3 = shl i64 %.280.epil, 3
  %4 = mul i64 %.283.epil, %lsr.iv
  %5 = getelementptr i8, ptr %lsr.iv53, i64 %4
  %scevgep = getelementptr i8, ptr %5, i64 %3
  %.290.epil = load double, ptr %scevgep, align 8
  %scevgep51 = getelementptr i8, ptr %lsr.iv49, i64 %3
  %.297.epil = load double, ptr %scevgep51, align 8
  %.299.epil = fmul double %.154, %.297.epil
  %.300.epil = fadd double %.290.epil, %.299.epil
  store double %.300.epil, ptr %scevgep, align 8
  %scevgep50 = getelementptr i8, ptr %lsr.iv49, i64 8
  %scevgep54 = getelementptr i8, ptr %lsr.iv53, i64 8
  %lsr.iv.next57 = add nsw i64 %lsr.iv56, -1
  %epil.iter.cmp.not = icmp eq i64 %lsr.iv.next57, 0
  br i1 %epil.iter.cmp.not, label %B44.loopexit, label %B134.epil, !llvm.loop !99

B44.loopexit:
  %lsr.iv.next = add i64 %lsr.iv, 8
  %exitcond99.not = icmp eq i64 %.116, %.21
  br i1 %exitcond99.not, label %B244, label %B46.endif, !llvm.loop !100

B134:
  %.2468183 = phi i64 [ 0, %B134.preheader.new ], [ %.253.7, %B134 ]
  %.280 = load i64, ptr %sunkaddr90, align 8
  %.283 = load i64, ptr %.159, align 8
  %6 = shl i64 %.280, 3
  %7 = shl i64 %.2468183, 3
  %8 = mul i64 %.283, %lsr.iv
  %9 = getelementptr i8, ptr %arg.out, i64 %8
  %scevgep87 = getelementptr i8, ptr %9, i64 %6
  %scevgep88 = getelementptr i8, ptr %scevgep87, i64 %7
  %.290 = load double, ptr %scevgep88, align 8
  %scevgep44 = getelementptr i8, ptr %arg.N, i64 %6
  %scevgep45 = getelementptr i8, ptr %scevgep44, i64 %7
  %.297 = load double, ptr %scevgep45, align 8
  %.299 = fmul double %.154, %.297
  %.300 = fadd double %.290, %.299
  store double %.300, ptr %scevgep88, align 8
  %.280.1 = load i64, ptr %sunkaddr90, align 8
  %.283.1 = load i64, ptr %.159, align 8
  %10 = shl i64 %.280.1, 3
  %11 = mul i64 %.283.1, %lsr.iv
  %12 = getelementptr i8, ptr %arg.out, i64 %11
  %scevgep84 = getelementptr i8, ptr %12, i64 %10
  %scevgep85 = getelementptr i8, ptr %scevgep84, i64 %7
  %scevgep86 = getelementptr i8, ptr %scevgep85, i64 8
  %.290.1 = load double, ptr %scevgep86, align 8
  %scevgep41 = getelementptr i8, ptr %arg.N, i64 %10
  %scevgep82 = getelementptr i8, ptr %scevgep41, i64 %7
  %scevgep83 = getelementptr i8, ptr %scevgep82, i64 8
  %.297.1 = load double, ptr %scevgep83, align 8
  %.299.1 = fmul double %.154, %.297.1
  %.300.1 = fadd double %.290.1, %.299.1
  store double %.300.1, ptr %scevgep86, align 8
  %.280.2 = load i64, ptr %sunkaddr90, align 8
  %.283.2 = load i64, ptr %.159, align 8
  %13 = shl i64 %.280.2, 3
  %14 = mul i64 %.283.2, %lsr.iv
  %15 = getelementptr i8, ptr %arg.out, i64 %14
  %scevgep79 = getelementptr i8, ptr %15, i64 %13
  %scevgep80 = getelementptr i8, ptr %scevgep79, i64 %7
  %scevgep81 = getelementptr i8, ptr %scevgep80, i64 16
  %.290.2 = load double, ptr %scevgep81, align 8
  %scevgep35 = getelementptr i8, ptr %arg.N, i64 %13
  %scevgep77 = getelementptr i8, ptr %scevgep35, i64 %7
  %scevgep78 = getelementptr i8, ptr %scevgep77, i64 16
  %.297.2 = load double, ptr %scevgep78, align 8
  %.299.2 = fmul double %.154, %.297.2
  %.300.2 = fadd double %.290.2, %.299.2
  store double %.300.2, ptr %scevgep81, align 8
  %.280.3 = load i64, ptr %sunkaddr90, align 8
  %.283.3 = load i64, ptr %.159, align 8
  %16 = shl i64 %.280.3, 3
  %17 = mul i64 %.283.3, %lsr.iv
  %18 = getelementptr i8, ptr %arg.out, i64 %17
  %scevgep74 = getelementptr i8, ptr %18, i64 %16
  %scevgep75 = getelementptr i8, ptr %scevgep74, i64 %7
  %scevgep76 = getelementptr i8, ptr %scevgep75, i64 24
  %.290.3 = load double, ptr %scevgep76, align 8
  %scevgep29 = getelementptr i8, ptr %arg.N, i64 %16
  %scevgep72 = getelementptr i8, ptr %scevgep29, i64 %7
  %scevgep73 = getelementptr i8, ptr %scevgep72, i64 24
  %.297.3 = load double, ptr %scevgep73, align 8
  %.299.3 = fmul double %.154, %.297.3
  %.300.3 = fadd double %.290.3, %.299.3
  store double %.300.3, ptr %scevgep76, align 8
  %.280.4 = load i64, ptr %sunkaddr90, align 8
  %.283.4 = load i64, ptr %.159, align 8
  %19 = shl i64 %.280.4, 3
  %20 = mul i64 %.283.4, %lsr.iv
  %21 = getelementptr i8, ptr %arg.out, i64 %20
  %scevgep69 = getelementptr i8, ptr %21, i64 %19
  %scevgep70 = getelementptr i8, ptr %scevgep69, i64 %7
  %scevgep71 = getelementptr i8, ptr %scevgep70, i64 32
  %.290.4 = load double, ptr %scevgep71, align 8
  %scevgep23 = getelementptr i8, ptr %arg.N, i64 %19
  %scevgep67 = getelementptr i8, ptr %scevgep23, i64 %7
  %scevgep68 = getelementptr i8, ptr %scevgep67, i64 32
  %.297.4 = load double, ptr %scevgep68, align 8
  %.299.4 = fmul double %.154, %.297.4
  %.300.4 = fadd double %.290.4, %.299.4
  store double %.300.4, ptr %scevgep71, align 8
  %.280.5 = load i64, ptr %sunkaddr90, align 8
  %.283.5 = load i64, ptr %.159, align 8
  %22 = shl i64 %.280.5, 3
  %23 = mul i64 %.283.5, %lsr.iv
  %24 = getelementptr i8, ptr %arg.out, i64 %23
  %scevgep64 = getelementptr i8, ptr %24, i64 %22
  %scevgep65 = getelementptr i8, ptr %scevgep64, i64 %7
  %scevgep66 = getelementptr i8, ptr %scevgep65, i64 40
  %.290.5 = load double, ptr %scevgep66, align 8
  %scevgep17 = getelementptr i8, ptr %arg.N, i64 %22
  %scevgep62 = getelementptr i8, ptr %scevgep17, i64 %7
  %scevgep63 = getelementptr i8, ptr %scevgep62, i64 40
  %.297.5 = load double, ptr %scevgep63, align 8
  %.299.5 = fmul double %.154, %.297.5
  %.300.5 = fadd double %.290.5, %.299.5
  store double %.300.5, ptr %scevgep66, align 8
  %.280.6 = load i64, ptr %sunkaddr90, align 8
  %.283.6 = load i64, ptr %.159, align 8
  %25 = shl i64 %.280.6, 3
  %26 = mul i64 %.283.6, %lsr.iv
  %27 = getelementptr i8, ptr %arg.out, i64 %26
  %scevgep59 = getelementptr i8, ptr %27, i64 %25
  %scevgep60 = getelementptr i8, ptr %scevgep59, i64 %7
  %scevgep61 = getelementptr i8, ptr %scevgep60, i64 48
  %.290.6 = load double, ptr %scevgep61, align 8
  %scevgep11 = getelementptr i8, ptr %arg.N, i64 %25
  %scevgep57 = getelementptr i8, ptr %scevgep11, i64 %7
  %scevgep58 = getelementptr i8, ptr %scevgep57, i64 48
  %.297.6 = load double, ptr %scevgep58, align 8
  %.299.6 = fmul double %.154, %.297.6
  %.300.6 = fadd double %.290.6, %.299.6
  store double %.300.6, ptr %scevgep61, align 8
  %.253.7 = add nuw nsw i64 %.2468183, 8
  %.280.7 = load i64, ptr %sunkaddr90, align 8
  %.283.7 = load i64, ptr %.159, align 8
  %28 = shl i64 %.280.7, 3
  %29 = mul i64 %.283.7, %lsr.iv
  %30 = getelementptr i8, ptr %arg.out, i64 %29
  %scevgep49 = getelementptr i8, ptr %30, i64 %28
  %scevgep53 = getelementptr i8, ptr %scevgep49, i64 %7
  %scevgep56 = getelementptr i8, ptr %scevgep53, i64 56
  %.290.7 = load double, ptr %scevgep56, align 8
  %scevgep5 = getelementptr i8, ptr %arg.N, i64 %28
  %scevgep1 = getelementptr i8, ptr %scevgep5, i64 %7
  %scevgep2 = getelementptr i8, ptr %scevgep1, i64 56
  %.297.7 = load double, ptr %scevgep2, align 8
  %.299.7 = fmul double %.154, %.297.7
  %.300.7 = fadd double %.290.7, %.299.7
  store double %.300.7, ptr %scevgep56, align 8
  %niter.ncmp.7 = icmp eq i64 %unroll_iter, %.253.7
  br i1 %niter.ncmp.7, label %B44.loopexit.loopexit.unr-lcssa, label %B134

B244:
  store ptr null, ptr %retptr, align 8
  ret i32 0

B46.endif:
  %lsr.iv = phi i64 [ %lsr.iv.next, %B44.loopexit ], [ 0, %B46.endif.preheader ]
  %.1098793 = phi i64 [ %.116, %B44.loopexit ], [ 0, %B46.endif.preheader ]
  %.116 = add nuw nsw i64 %.1098793, 1
  %.146 = load i64, ptr %.20, align 8
  %.148 = mul nsw i64 %.146, %.1098793
  %31 = getelementptr double, ptr %arg.M, i64 %.148
  %.151 = getelementptr i8, ptr %31, i64 8
  %.152 = load double, ptr %.151, align 8
  %.154 = fmul double %arg.factor, %.152
  %.160 = load i64, ptr %.159, align 8
  %.24082.not = icmp slt i64 %.160, 1
  br i1 %.24082.not, label %B44.loopexit, label %B134.preheader

B134.preheader:
  %xtraiter = and i64 %.160, 7
  %32 = icmp samesign ult i64 %.160, 8
  br i1 %32, label %B134.epil.preheader, label %B134.preheader.new

B134.preheader.new:
  %unroll_iter = and i64 %.160, 9223372036854775800
  br label %B134
}


define ptr @exponential(ptr %.1, i64 %.2, double %.3, double %.4, ptr %.5, ptr readonly %.6, ptr %.7) local_unnamed_addr #0 {
entry:
  %.9 = alloca ptr, align 8
  store ptr null, ptr %.9, align 8
  %excinfo = alloca ptr, align 8
  %.13 = call i32 @_ZN18biped_adrc_kernels11exponentialB3v26B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axdd10float64_2a10float64_2a10float64_2a(ptr nonnull %.9, ptr nonnull %excinfo, ptr %.1, i64 %.2, double %.3, double %.4, ptr %.5, ptr %.6, ptr %.7) #0
  %cond = icmp eq i32 %.13, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.23 = load ptr, ptr %.9, align 8
  ret ptr %.23
}

define i32 @_ZN18biped_adrc_kernels5halveB3v35B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axdddd(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r, i64 %arg.guard, double %arg.t, double %arg.ta, double %arg.tb, double %arg.fb) local_unnamed_addr {
B0:
  %.98 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.133 = alloca ptr, align 8
  %excinfo.2 = alloca ptr, align 8
  %.492 = alloca ptr, align 8
  %excinfo.5 = alloca ptr, align 8
  %.25 = getelementptr i8, ptr %arg.r, i64 128
  %.26 = load i64, ptr %.25, align 8
  %.38 = getelementptr i8, ptr %arg.r, i64 840
  %.39 = load i64, ptr %.38, align 8
  %.40 = inttoptr i64 %.39 to ptr
  %.42 = getelementptr i8, ptr %arg.r, i64 896
  %.43 = load i64, ptr %.42, align 8
  %.46 = getelementptr i8, ptr %arg.r, i64 848
  %.47 = load i64, ptr %.46, align 8
  %.50 = getelementptr i8, ptr %arg.r, i64 784
  %.51 = load i64, ptr %.50, align 8
  %.91 = getelementptr i8, ptr %arg.r, i64 800
  %.92 = load i64, ptr %.91, align 8
  %.93 = inttoptr i64 %.92 to ptr
  %.95 = getelementptr i8, ptr %arg.r, i64 80
  %.96 = load i64, ptr %.95, align 8
  %.102 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.98, ptr nonnull %excinfo.1, ptr %.93, ptr %.40, i64 %.96)
  switch i32 %.102, label %B0.if.if [
    i32 -2, label %B0.endif
    i32 0, label %B0.endif
  ], !prof !8

B262:
  %lsr.iv = phi i64 [ %1, %B262.lr.ph ], [ %lsr.iv.next, %B631 ]
  %count.2.089 = phi i64 [ 0, %B262.lr.ph ], [ %count.3.1, %B631 ]
  %now.2.088 = phi double [ %arg.t, %B262.lr.ph ], [ %now.3.1, %B631 ]
  %fb.2.087 = phi double [ %arg.fb, %B262.lr.ph ], [ %fb.3.1, %B631 ]
  %tb.2.086 = phi double [ %arg.tb, %B262.lr.ph ], [ %tb.3.1, %B631 ]
  %.2778184 = phi i64 [ 1, %B262.lr.ph ], [ %.284, %B631 ]
  %.316 = shl nuw i64 1, %lsr.iv
  %.318 = add nsw i64 %.316, %count.2.089
  %.324 = sitofp i64 %.318 to double
  %.325 = fmul double %.187, %.324
  %.327 = fadd double %arg.t, %.325
  %.333 = fcmp ogt double %.327, %arg.ta
  br i1 %.333, label %B320, label %B334

B320:
  %.337 = fcmp ult double %.327, %tb.2.086
  br i1 %.337, label %B394.endif, label %B631

B334:
  %.372 = fsub double %.327, %now.2.088
  %.379 = tail call ptr @exponential(ptr %arg.r, i64 %.2778184, double %now.2.088, double %.372, ptr %.40, ptr %0, ptr %2)
  br label %B540

B540:
  %.489 = load i64, ptr %.95, align 8
  %.496 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.492, ptr nonnull %excinfo.5, ptr %2, ptr %.40, i64 %.489)
  switch i32 %.496, label %B540.if.if [
    i32 -2, label %B540.endif
    i32 0, label %B540.endif
  ], !prof !8

B631:
  %tb.3.1 = phi double [ %tb.2.086, %B320 ], [ %tb.2.086, %B540.endif ], [ %.327, %B394.endif ]
  %fb.3.1 = phi double [ %fb.2.087, %B320 ], [ %fb.2.087, %B540.endif ], [ %.428, %B394.endif ]
  %now.3.1 = phi double [ %now.2.088, %B320 ], [ %.327, %B540.endif ], [ %now.2.088, %B394.endif ]
  %count.3.1 = phi i64 [ %count.2.089, %B320 ], [ %.318, %B540.endif ], [ %count.2.089, %B394.endif ]
  %lsr.iv.next = add i64 %lsr.iv, -1
  %.284 = add nuw i64 %.2778184, 1
  %exitcond.not = icmp eq i64 %lsr.iv, 0
  br i1 %exitcond.not, label %B630.endif, label %B262

B0.endif:
  %0 = inttoptr i64 %.43 to ptr
  %.126 = getelementptr i8, ptr %arg.r, i64 856
  %.127 = load i64, ptr %.126, align 8
  %.128 = inttoptr i64 %.127 to ptr
  %.130 = getelementptr i8, ptr %arg.r, i64 120
  %.131 = load i64, ptr %.130, align 8
  %.137 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.133, ptr nonnull %excinfo.2, ptr %.128, ptr %0, i64 %.131)
  switch i32 %.137, label %B0.endif.if.if [
    i32 -2, label %B0.endif.endif
    i32 0, label %B0.endif.endif
  ], !prof !8

common.ret:
  %common.ret.op = phi i32 [ %.102, %B0.if.if ], [ %.137, %B0.endif.if.if ], [ 1, %B0.endif.endif.if.if ], [ 0, %B630.endif ], [ %.496, %B540.if.if ]
  ret i32 %common.ret.op

B0.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B0.endif.endif:
  %.158 = getelementptr i8, ptr %arg.r, i64 248
  %.160 = load double, ptr %.158, align 8
  %.162 = add i64 %.26, -1
  %.16.i = icmp slt i64 %.162, 0
  br i1 %.16.i, label %B62.i, label %B190.i

B62.i:
  %.22.i = sub i64 1, %.26
  %.27.i = icmp slt i64 %.22.i, 0
  br i1 %.27.i, label %B0.endif.endif.if.if, label %B190.i

B190.i:
  %exp.3.0.i = phi i64 [ %.22.i, %B62.i ], [ %.162, %B0.endif.endif ]
  %.67.i = icmp samesign ugt i64 %exp.3.0.i, 65536
  br i1 %.67.i, label %B202.i, label %B270.i

B202.i:
  %.76.i = sitofp i64 %.162 to double
  %mul = fneg double %.76.i
  %exp2 = tail call double @llvm.exp2.f64(double %mul)
  br label %B0.endif.endif.endif.endif

B270.i:
  %.108.not.i = icmp eq i64 %exp.3.0.i, 0
  br i1 %.108.not.i, label %B334.thread.i, label %B282.i

B282.i:
  %r.2.0.i = phi double [ %spec.select.i, %B282.i ], [ 1.000000e+00, %B270.i ]
  %a.1.2.0.i = phi double [ %.147.i, %B282.i ], [ 5.000000e-01, %B270.i ]
  %exp.4.0.i = phi i64 [ %.142.i, %B282.i ], [ %exp.3.0.i, %B270.i ]
  %.122.i = and i64 %exp.4.0.i, 1
  %.123.not.i = icmp eq i64 %.122.i, 0
  %.127.i = fmul double %r.2.0.i, %a.1.2.0.i
  %spec.select.i = select i1 %.123.not.i, double %r.2.0.i, double %.127.i
  %.142.i = lshr i64 %exp.4.0.i, 1
  %.147.i = fmul double %a.1.2.0.i, %a.1.2.0.i
  %.150.not.i = icmp eq i64 %.142.i, 0
  br i1 %.150.not.i, label %B334.i, label %B282.i

B334.i:
  br i1 %.16.i, label %B338.i, label %B0.endif.endif.endif.endif

B334.thread.i:
  br i1 %.16.i, label %B630.endif, label %B0.endif.endif.endif.endif

B338.i:
  %.168.i = fcmp oeq double %spec.select.i, 0.000000e+00
  br i1 %.168.i, label %B0.endif.endif.if.if, label %B630.endif, !prof !102

B0.endif.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B0.endif.endif.if.if:
  %excinfo.3.0 = phi ptr [ @.const.picklebuf.b28008a0f88bad5ff0f0243e84dab90cab19b366, %B338.i ], [ @.const.picklebuf.8928cf367dcdb5b06f67cce68474c0d77d61c7bd, %B62.i ]
  store ptr %excinfo.3.0, ptr %excinfo, align 8
  br label %common.ret

B0.endif.endif.endif.endif:
  %.163.0.ph = phi double [ 1.000000e+00, %B334.thread.i ], [ %spec.select.i, %B334.i ], [ %exp2, %B202.i ]
  %.187 = fmul double %.160, %.163.0.ph
  %.27183.not = icmp slt i64 %.162, 1
  br i1 %.27183.not, label %B630.endif, label %B262.lr.ph

B262.lr.ph:
  %1 = add i64 %.26, -2
  %2 = inttoptr i64 %.47 to ptr
  %3 = inttoptr i64 %.51 to ptr
  %sunkaddr15 = getelementptr i8, ptr %arg.r, i64 40
  %sunkaddr16 = getelementptr i8, ptr %arg.r, i64 272
  %sunkaddr17 = getelementptr i8, ptr %arg.r, i64 688
  br label %B262

B394.endif:
  %.37267 = fsub double %.327, %now.2.088
  %.37968 = tail call ptr @exponential(ptr %arg.r, i64 %.2778184, double %now.2.088, double %.37267, ptr %.40, ptr %0, ptr %2)
  %.8.i = load i64, ptr %sunkaddr15, align 8, !noalias !103
  %.10.i = load i64, ptr %sunkaddr16, align 8, !noalias !103
  %.11.i = inttoptr i64 %.10.i to ptr
  %.12.i = inttoptr i64 %.8.i to ptr
  tail call void %.12.i(ptr %.11.i, ptr %2, ptr %3), !noalias !103
  %.416 = load i64, ptr %sunkaddr17, align 8
  %.417 = inttoptr i64 %.416 to ptr
  %.421 = tail call ptr @watch(ptr %arg.r, double %.327, ptr %3, ptr %.417)
  %.424 = load i64, ptr %sunkaddr17, align 8
  %.425 = inttoptr i64 %.424 to ptr
  %.427 = getelementptr double, ptr %.425, i64 %arg.guard
  %.428 = load double, ptr %.427, align 8
  %.429 = fcmp ogt double %.428, 0.000000e+00
  br i1 %.429, label %B540, label %B631

B540.endif:
  %.519 = tail call ptr @remainder(ptr nonnull %arg.r, double %.327, ptr %.40, ptr %0)
  br label %B631

B540.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B630.endif:
  %tb.2.0.lcssa = phi double [ %arg.tb, %B0.endif.endif.endif.endif ], [ %arg.tb, %B338.i ], [ %arg.tb, %B334.thread.i ], [ %tb.3.1, %B631 ]
  %fb.2.0.lcssa = phi double [ %arg.fb, %B0.endif.endif.endif.endif ], [ %arg.fb, %B338.i ], [ %arg.fb, %B334.thread.i ], [ %fb.3.1, %B631 ]
  %now.2.0.lcssa = phi double [ %arg.t, %B0.endif.endif.endif.endif ], [ %arg.t, %B338.i ], [ %arg.t, %B334.thread.i ], [ %now.3.1, %B631 ]
  %4 = inttoptr i64 %.51 to ptr
  %.7.i1 = getelementptr i8, ptr %arg.r, i64 40
  %.8.i2 = load i64, ptr %.7.i1, align 8, !noalias !106
  %.9.i3 = getelementptr i8, ptr %arg.r, i64 272
  %.10.i4 = load i64, ptr %.9.i3, align 8, !noalias !106
  %.11.i5 = inttoptr i64 %.10.i4 to ptr
  %.12.i6 = inttoptr i64 %.8.i2 to ptr
  tail call void %.12.i6(ptr %.11.i5, ptr %.40, ptr %4), !noalias !106
  %.572 = getelementptr i8, ptr %arg.r, i64 792
  %.573 = load i64, ptr %.572, align 8
  %.574 = inttoptr i64 %.573 to ptr
  %.578 = tail call ptr @flow(ptr %arg.r, double %now.2.0.lcssa, ptr %4, ptr %.574)
  %.583 = getelementptr i8, ptr %arg.r, i64 528
  store double %now.2.0.lcssa, ptr %.583, align 8
  %.590 = getelementptr i8, ptr %arg.r, i64 536
  store double %tb.2.0.lcssa, ptr %.590, align 8
  %.597 = getelementptr i8, ptr %arg.r, i64 544
  store double %fb.2.0.lcssa, ptr %.597, align 8
  store ptr null, ptr %retptr, align 8
  br label %common.ret
}


declare double @llvm.exp2.f64(double) #2


define ptr @halve(ptr %.1, i64 %.2, double %.3, double %.4, double %.5, double %.6) local_unnamed_addr #0 {
entry:
  %.8 = alloca ptr, align 8
  store ptr null, ptr %.8, align 8
  %excinfo = alloca ptr, align 8
  %.12 = call i32 @_ZN18biped_adrc_kernels5halveB3v35B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axdddd(ptr nonnull %.8, ptr nonnull %excinfo, ptr %.1, i64 %.2, double %.3, double %.4, double %.5, double %.6) #0
  %cond = icmp eq i32 %.12, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.22 = load ptr, ptr %.8, align 8
  ret ptr %.22
}


define i32 @_ZN18biped_adrc_kernels6retakeB3v38B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add(ptr noalias writeonly initializes((0, 8)) %retptr, ptr noalias readnone %excinfo, ptr %arg.r, double %arg.t0, double %arg.s) local_unnamed_addr #0 {
B0:
  %.14 = getelementptr i8, ptr %arg.r, i64 144
  %.15 = load i64, ptr %.14, align 8
  switch i64 %.15, label %B70.i4 [
    i64 1, label %B36
    i64 2, label %common.ret
  ]

B36:
  %.22 = tail call ptr @halve(ptr nonnull %arg.r, i64 -1, double %arg.t0, double %arg.s, double %arg.s, double 0.000000e+00)
  %.21.i = load i64, ptr %.14, align 8, !noalias !109
  %.22.i = icmp eq i64 %.21.i, 2
  br i1 %.22.i, label %common.ret, label %B70.i

B70.i:
  %.35 = getelementptr i8, ptr %arg.r, i64 792
  %.36 = load i64, ptr %.35, align 8
  %.37 = inttoptr i64 %.36 to ptr
  %.31 = getelementptr i8, ptr %arg.r, i64 784
  %.32 = load i64, ptr %.31, align 8
  %.33 = inttoptr i64 %.32 to ptr
  %.27 = getelementptr i8, ptr %arg.r, i64 528
  %.29 = load double, ptr %.27, align 8
  %.62.i = fsub double %arg.s, %.29
  %.64.i = getelementptr i8, ptr %arg.r, i64 768
  %.65.i = load i64, ptr %.64.i, align 8, !noalias !109
  %.66.i = inttoptr i64 %.65.i to ptr
  %.71.i = tail call ptr @classical(ptr nonnull %arg.r, double %.29, ptr %.33, ptr %.37, double %.62.i, ptr %.66.i), !noalias !109
  br label %common.ret

B70.i4:
  %.78 = getelementptr i8, ptr %arg.r, i64 704
  %.79 = load i64, ptr %.78, align 8
  %.80 = inttoptr i64 %.79 to ptr
  %.74 = getelementptr i8, ptr %arg.r, i64 696
  %.75 = load i64, ptr %.74, align 8
  %.76 = inttoptr i64 %.75 to ptr
  %.62.i5 = fsub double %arg.s, %arg.t0
  %.64.i6 = getelementptr i8, ptr %arg.r, i64 768
  %.65.i7 = load i64, ptr %.64.i6, align 8, !noalias !112
  %.66.i8 = inttoptr i64 %.65.i7 to ptr
  %.71.i9 = tail call ptr @classical(ptr nonnull %arg.r, double %arg.t0, ptr %.76, ptr %.80, double %.62.i5, ptr %.66.i8), !noalias !112
  br label %common.ret

common.ret:
  %.80.i10 = getelementptr i8, ptr %arg.r, i64 768
  %.81.i11 = load i64, ptr %.80.i10, align 8, !noalias !115
  %.82.i12 = inttoptr i64 %.81.i11 to ptr
  %.84.i13 = getelementptr i8, ptr %arg.r, i64 688
  %.85.i14 = load i64, ptr %.84.i13, align 8, !noalias !115
  %.86.i15 = inttoptr i64 %.85.i14 to ptr
  %.89.i16 = tail call ptr @watch(ptr nonnull %arg.r, double %arg.s, ptr %.82.i12, ptr %.86.i15), !noalias !115
  store ptr null, ptr %retptr, align 8
  ret i32 0
}


define ptr @retake(ptr %.1, double %.2, double %.3) local_unnamed_addr #0 {
entry:
  %.5 = alloca ptr, align 8
  %.9 = call i32 @_ZN18biped_adrc_kernels6retakeB3v38B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add(ptr nonnull %.5, ptr nonnull poison, ptr %.1, double %.2, double %.3) #0
  %.19 = load ptr, ptr %.5, align 8
  ret ptr %.19
}

define i32 @_ZN18biped_adrc_kernels6locateB3v41B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axddd(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r, i64 %arg.guard, double %arg.t0, double %arg.ta, double %arg.tb) local_unnamed_addr {
B0:
  %.241 = alloca double, align 8
  %excinfo.1 = alloca ptr, align 8
  %.28 = getelementptr i8, ptr %arg.r, i64 672
  %.29 = load i64, ptr %.28, align 8
  %.30 = inttoptr i64 %.29 to ptr
  %.32 = getelementptr double, ptr %.30, i64 %arg.guard
  %.33 = load double, ptr %.32, align 8
  %.35 = getelementptr i8, ptr %arg.r, i64 680
  %.36 = load i64, ptr %.35, align 8
  %.37 = inttoptr i64 %.36 to ptr
  %.39 = getelementptr double, ptr %.37, i64 %arg.guard
  %.40 = load double, ptr %.39, align 8
  %.56 = getelementptr i8, ptr %arg.r, i64 696
  %.57 = load i64, ptr %.56, align 8
  %.58 = inttoptr i64 %.57 to ptr
  %.60 = getelementptr i8, ptr %arg.r, i64 704
  %.61 = load i64, ptr %.60, align 8
  %.74 = getelementptr i8, ptr %arg.r, i64 144
  %.75 = load i64, ptr %.74, align 8
  %.76 = icmp eq i64 %.75, 1
  br i1 %.76, label %B120, label %B324

B120:
  %.92 = tail call ptr @halve(ptr nonnull %arg.r, i64 %arg.guard, double %arg.t0, double %arg.ta, double %arg.tb, double %.40)
  %.100 = getelementptr i8, ptr %arg.r, i64 528
  %.102 = load double, ptr %.100, align 8
  %.104 = getelementptr i8, ptr %arg.r, i64 536
  %.106 = load double, ptr %.104, align 8
  %.108 = getelementptr i8, ptr %arg.r, i64 544
  %.110 = load double, ptr %.108, align 8
  %.112 = getelementptr i8, ptr %arg.r, i64 784
  %.113 = load i64, ptr %.112, align 8
  %.114 = inttoptr i64 %.113 to ptr
  %.116 = getelementptr i8, ptr %arg.r, i64 792
  %.117 = load i64, ptr %.116, align 8
  %.161 = fcmp ogt double %.102, %arg.ta
  br i1 %.161, label %B248, label %B324

B248:
  %.187 = getelementptr i8, ptr %arg.r, i64 688
  %.188 = load i64, ptr %.187, align 8
  %.189 = inttoptr i64 %.188 to ptr
  %.193 = tail call ptr @watch(ptr nonnull %arg.r, double %.102, ptr %.114, ptr %.189)
  %.198 = load i64, ptr %.187, align 8
  %.199 = inttoptr i64 %.198 to ptr
  %.201 = getelementptr double, ptr %.199, i64 %arg.guard
  %.202 = load double, ptr %.201, align 8
  br label %B324

B324:
  %ta.2.0 = phi double [ %.102, %B248 ], [ %arg.ta, %B120 ], [ %arg.ta, %B0 ]
  %tb.2.0 = phi double [ %.106, %B248 ], [ %.106, %B120 ], [ %arg.tb, %B0 ]
  %fb.2.0 = phi double [ %.110, %B248 ], [ %.110, %B120 ], [ %.40, %B0 ]
  %fa.2.0 = phi double [ %.202, %B248 ], [ %.33, %B120 ], [ %.33, %B0 ]
  %dx.2.0.in = phi i64 [ %.117, %B248 ], [ %.117, %B120 ], [ %.61, %B0 ]
  %x.2.0 = phi ptr [ %.114, %B248 ], [ %.114, %B120 ], [ %.58, %B0 ]
  %base.2.0 = phi double [ %.102, %B248 ], [ %.102, %B120 ], [ %arg.t0, %B0 ]
  %dx.2.0 = inttoptr i64 %dx.2.0.in to ptr
  store double 0.000000e+00, ptr %.241, align 8
  %.245 = call i32 @_ZN18biped_adrc_kernels5brentB3v42B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd10float64_2a10float64_2adddd(ptr nonnull %.241, ptr nonnull %excinfo.1, ptr nonnull %arg.r, i64 %arg.guard, double %base.2.0, ptr %x.2.0, ptr %dx.2.0, double %ta.2.0, double %fa.2.0, double %tb.2.0, double %fb.2.0)
  %.255 = load double, ptr %.241, align 8
  %cond = icmp eq i32 %.245, 0
  br i1 %cond, label %B324.endif, label %B324.if.if, !prof !24

B324.endif:
  %.21.i = load i64, ptr %.74, align 8, !noalias !116
  %.22.i = icmp eq i64 %.21.i, 2
  br i1 %.22.i, label %B324.endif.endif, label %B70.i

B70.i:
  %.62.i = fsub double %.255, %base.2.0
  %.64.i = getelementptr i8, ptr %arg.r, i64 768
  %.65.i = load i64, ptr %.64.i, align 8, !noalias !116
  %.66.i = inttoptr i64 %.65.i to ptr
  %.71.i = tail call ptr @classical(ptr nonnull %arg.r, double %base.2.0, ptr %x.2.0, ptr %dx.2.0, double %.62.i, ptr %.66.i), !noalias !116
  br label %B324.endif.endif

common.ret:
  ret i32 %.245

B324.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B324.endif.endif:
  %.80.i = getelementptr i8, ptr %arg.r, i64 768
  %.81.i = load i64, ptr %.80.i, align 8, !noalias !116
  %.82.i = inttoptr i64 %.81.i to ptr
  %.84.i = getelementptr i8, ptr %arg.r, i64 688
  %.85.i = load i64, ptr %.84.i, align 8, !noalias !116
  %.86.i = inttoptr i64 %.85.i to ptr
  %.89.i = tail call ptr @watch(ptr nonnull %arg.r, double %.255, ptr %.82.i, ptr %.86.i), !noalias !116
  store double %.255, ptr %retptr, align 8
  br label %common.ret
}

define linkonce_odr i32 @_ZN18biped_adrc_kernels5brentB3v42B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd10float64_2a10float64_2adddd(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr %arg.r, i64 %arg.guard, double %arg.base, ptr %arg.x, ptr %arg.dx, double %arg.ta, double %arg.fa, double %arg.tb, double %arg.fb) local_unnamed_addr {
B92.lr.ph:
  %.65 = fsub double %arg.tb, %arg.ta
  %sunkaddr3 = getelementptr i8, ptr %arg.r, i64 144
  %sunkaddr = getelementptr i8, ptr %arg.r, i64 768
  %sunkaddr5 = getelementptr i8, ptr %arg.r, i64 688
  br label %B92

B92:
  %lsr.iv1 = phi i64 [ %lsr.iv.next2, %B918.endif ], [ 10002, %B92.lr.ph ]
  %step.5.079 = phi double [ %step.6.1, %B918.endif ], [ %.65, %B92.lr.ph ]
  %last.5.078 = phi double [ %last.6.1, %B918.endif ], [ %.65, %B92.lr.ph ]
  %other.4.077 = phi double [ %other.5.1, %B918.endif ], [ %arg.ta, %B92.lr.ph ]
  %f_other.4.076 = phi double [ %f_other.5.1, %B918.endif ], [ %arg.fa, %B92.lr.ph ]
  %f_now.3.075 = phi double [ %.700, %B918.endif ], [ %arg.fb, %B92.lr.ph ]
  %now.4.074 = phi double [ %now.5.1, %B918.endif ], [ %arg.tb, %B92.lr.ph ]
  %f_before.3.073 = phi double [ %f_now.4.1, %B918.endif ], [ %arg.fa, %B92.lr.ph ]
  %before.3.072 = phi double [ %now.6.1, %B918.endif ], [ %arg.ta, %B92.lr.ph ]
  %or.cond = fcmp ueq double %f_now.3.075, 0.000000e+00
  br i1 %or.cond, label %common.ret, label %B126

common.ret:
  %now.5.1.lcssa.sink = phi double [ %now.6.1, %B264 ], [ %now.4.074, %B92 ], [ %now.6.1, %B360 ], [ %now.5.1, %B918.endif ]
  store double %now.5.1.lcssa.sink, ptr %retptr, align 8
  ret i32 0

B126:
  %.255 = fcmp olt double %f_before.3.073, 0.000000e+00
  %.257 = fcmp olt double %f_now.3.075, 0.000000e+00
  %.258 = xor i1 %.257, %.255
  br i1 %.258, label %B154, label %B176

B154:
  %.268 = fsub double %now.4.074, %before.3.072
  br label %B176

B176:
  %f_other.3.1 = phi double [ %f_before.3.073, %B154 ], [ %f_other.4.076, %B126 ]
  %other.3.1 = phi double [ %before.3.072, %B154 ], [ %other.4.077, %B126 ]
  %last.4.1 = phi double [ %.268, %B154 ], [ %last.5.078, %B126 ]
  %step.4.1 = phi double [ %.268, %B154 ], [ %step.5.079, %B126 ]
  %.303 = tail call double @llvm.fabs.f64(double %f_other.3.1)
  %.305 = tail call double @llvm.fabs.f64(double %f_now.3.075)
  %.306 = fcmp olt double %.303, %.305
  br i1 %.306, label %B240, label %B264

B240:
  br label %B264

B264:
  %before.4.1 = phi double [ %now.4.074, %B240 ], [ %before.3.072, %B176 ]
  %f_before.4.1 = phi double [ %f_now.3.075, %B240 ], [ %f_before.3.073, %B176 ]
  %now.6.1 = phi double [ %other.3.1, %B240 ], [ %now.4.074, %B176 ]
  %f_now.4.1 = phi double [ %f_other.3.1, %B240 ], [ %f_now.3.075, %B176 ]
  %f_other.5.1 = phi double [ %f_now.3.075, %B240 ], [ %f_other.3.1, %B176 ]
  %other.5.1 = phi double [ %now.4.074, %B240 ], [ %other.3.1, %B176 ]
  %.344 = tail call double @llvm.fabs.f64(double %now.6.1)
  %.345 = fmul double %.344, 9.000000e-16
  %.346 = fadd double %.345, 1.000000e-15
  %.347 = fmul double %.346, 5.000000e-01
  %.350 = fsub double %other.5.1, %now.6.1
  %.351 = fmul double %.350, 5.000000e-01
  %.359 = fcmp oeq double %f_now.4.1, 0.000000e+00
  br i1 %.359, label %common.ret, label %B360

B360:
  %.362 = tail call double @llvm.fabs.f64(double %.351)
  %.364 = fcmp olt double %.362, %.347
  br i1 %.364, label %common.ret, label %B406

B406:
  %.409 = tail call double @llvm.fabs.f64(double %last.4.1)
  %.411 = fcmp ogt double %.409, %.347
  br i1 %.411, label %B468, label %B678.endif

B468:
  %.419 = tail call double @llvm.fabs.f64(double %f_now.4.1)
  %.421 = tail call double @llvm.fabs.f64(double %f_before.4.1)
  %.422 = fcmp olt double %.419, %.421
  br i1 %.422, label %B532, label %B678.endif

B532:
  %.428 = fcmp oeq double %before.4.1, %other.5.1
  br i1 %.428, label %B544, label %B576

B544:
  %.431 = fneg double %f_now.4.1
  %.434 = fsub double %now.6.1, %before.4.1
  %.437 = fmul double %.434, %.431
  %.440 = fsub double %f_now.4.1, %f_before.4.1
  %.446 = fdiv double %.437, %.440
  br label %B678.endif

B576:
  %.452 = fsub double %f_before.4.1, %f_now.4.1
  %.455 = fsub double %before.4.1, %now.6.1
  %.461 = fdiv double %.452, %.455
  %.464 = fsub double %f_other.5.1, %f_now.4.1
  %.471 = fdiv double %.464, %.350
  %.472 = fmul double %.461, %.471
  %.475 = fsub double %f_other.5.1, %f_before.4.1
  %.476 = fmul double %.475, %.472
  %.478 = fneg double %f_now.4.1
  %.480 = fmul double %f_other.5.1, %.471
  %.482 = fmul double %f_before.4.1, %.461
  %.485 = fsub double %.480, %.482
  %.486 = fmul double %.485, %.478
  %.490 = fdiv double %.486, %.476
  br label %B678.endif

B678.endif:
  %trial.3.1 = phi double [ %.446, %B544 ], [ %.490, %B576 ], [ 0x7FF0000000000000, %B468 ], [ 0x7FF0000000000000, %B406 ]
  %.509 = fmul double %.362, 3.000000e+00
  %.511 = fsub double %.509, %.347
  %.12.i = fcmp olt double %.511, %.409
  %.13.i = select i1 %.12.i, double %.511, double %.409
  %.501 = tail call double @llvm.fabs.f64(double %trial.3.1)
  %.502 = fmul double %.501, 2.000000e+00
  %.540 = fcmp olt double %.502, %.13.i
  %step.6.1 = select i1 %.540, double %trial.3.1, double %.351
  %.577 = tail call double @llvm.fabs.f64(double %step.6.1)
  %.579 = fcmp ogt double %.577, %.347
  %.595 = fcmp ogt double %.351, 0.000000e+00
  %.613 = fneg double %.347
  %"$phi912.2.2.2" = select i1 %.595, double %.347, double %.613
  %step.6.1.pn = select i1 %.579, double %step.6.1, double %"$phi912.2.2.2"
  %now.5.1 = fadd double %now.6.1, %step.6.1.pn
  %.21.i = load i64, ptr %sunkaddr3, align 8, !noalias !119
  %.22.i = icmp eq i64 %.21.i, 2
  br i1 %.22.i, label %B918.endif, label %B70.i

B70.i:
  %.62.i = fsub double %now.5.1, %arg.base
  %.65.i = load i64, ptr %sunkaddr, align 8, !noalias !119
  %.66.i = inttoptr i64 %.65.i to ptr
  %.71.i = tail call ptr @classical(ptr nonnull %arg.r, double %arg.base, ptr %arg.x, ptr %arg.dx, double %.62.i, ptr %.66.i), !noalias !119
  br label %B918.endif

B918.endif:
  %.81.i = load i64, ptr %sunkaddr, align 8, !noalias !119
  %.82.i = inttoptr i64 %.81.i to ptr
  %.85.i = load i64, ptr %sunkaddr5, align 8, !noalias !119
  %.86.i = inttoptr i64 %.85.i to ptr
  %.89.i = tail call ptr @watch(ptr nonnull %arg.r, double %now.5.1, ptr %.82.i, ptr %.86.i), !noalias !119
  %last.6.1 = select i1 %.540, double %step.4.1, double %.351
  %.696 = load i64, ptr %sunkaddr5, align 8
  %.697 = inttoptr i64 %.696 to ptr
  %.699 = getelementptr double, ptr %.697, i64 %arg.guard
  %.700 = load double, ptr %.699, align 8
  %lsr.iv.next2 = add nsw i64 %lsr.iv1, -1
  %.154 = icmp samesign ugt i64 %lsr.iv1, 3
  br i1 %.154, label %B92, label %common.ret
}


declare double @llvm.fabs.f64(double) #2


define double @locate(ptr %.1, i64 %.2, double %.3, double %.4, double %.5) local_unnamed_addr #0 {
entry:
  %.7 = alloca double, align 8
  store double 0.000000e+00, ptr %.7, align 8
  %excinfo = alloca ptr, align 8
  %.11 = call i32 @_ZN18biped_adrc_kernels6locateB3v41B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axddd(ptr nonnull %.7, ptr nonnull %excinfo, ptr %.1, i64 %.2, double %.3, double %.4, double %.5) #0
  %cond = icmp eq i32 %.11, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.21 = load double, ptr %.7, align 8
  ret double %.21
}

define i32 @_ZN18biped_adrc_kernels4liftB3v43B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r, double %arg.t0, double %arg.s) local_unnamed_addr {
B0:
  %.5.i1 = alloca ptr, align 8
  %.5.i = alloca ptr, align 8
  %.34 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.307 = alloca ptr, align 8
  %excinfo.3 = alloca ptr, align 8
  %.334 = alloca i64, align 8
  %excinfo.4 = alloca ptr, align 8
  store ptr null, ptr %excinfo.4, align 8
  %.368 = alloca i64, align 8
  %excinfo.5 = alloca ptr, align 8
  %.420 = alloca ptr, align 8
  %excinfo.6 = alloca ptr, align 8
  %.15 = fsub double %arg.s, %arg.t0
  %.16 = fmul double %.15, 5.000000e-01
  %.18 = fadd double %arg.t0, %.16
  %.9.i = call i32 @_ZN18biped_adrc_kernels6retakeB3v38B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add(ptr nonnull %.5.i, ptr nonnull poison, ptr %arg.r, double %arg.t0, double %.18) #0
  %.24 = getelementptr i8, ptr %arg.r, i64 688
  %.25 = load i64, ptr %.24, align 8
  %.26 = inttoptr i64 %.25 to ptr
  %.28 = getelementptr i8, ptr %arg.r, i64 680
  %.29 = load i64, ptr %.28, align 8
  %.30 = inttoptr i64 %.29 to ptr
  %.32 = getelementptr i8, ptr %arg.r, i64 136
  %.33 = load i64, ptr %.32, align 8
  %.38 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.34, ptr nonnull %excinfo.1, ptr %.26, ptr %.30, i64 %.33)
  switch i32 %.38, label %B0.if.if [
    i32 -2, label %B0.endif.endif
    i32 0, label %B0.endif.endif
  ], !prof !8

B196:
  %.1527578 = phi i64 [ %.159, %B503 ], [ 1, %B503.peel ]
  %.159 = add nuw i64 %.1527578, 1
  %0 = shl i64 %.1527578, 3
  %scevgep8 = getelementptr i8, ptr %.190, i64 %0
  %.193 = load double, ptr %scevgep8, align 8
  %sunkaddr10 = getelementptr i8, ptr %.200, i64 %0
  %.203 = load double, ptr %sunkaddr10, align 8
  %.204 = fcmp oeq double %.203, 0.000000e+00
  %.211 = fcmp olt double %.193, 0.000000e+00
  %or.cond = select i1 %.204, i1 %.211, i1 false
  br i1 %or.cond, label %B278, label %B503

B278:
  %.225 = load i64, ptr %.28, align 8
  %.226 = inttoptr i64 %.225 to ptr
  %scevgep = getelementptr i8, ptr %.226, i64 %0
  %.229 = load double, ptr %scevgep, align 8
  %.230 = fmul double %.229, 3.000000e+00
  %.232 = fcmp olt double %.193, %.230
  br i1 %.232, label %B352, label %B503

common.ret:
  %common.ret.op = phi i32 [ 0, %B352 ], [ %.38, %B0.if.if ], [ %.424, %B502.if.if ], [ %.311, %B372.if.if ], [ %.338, %B372.endif.if.if ], [ %.372, %B468.if.if ], [ 0, %B502.endif ]
  ret i32 %common.ret.op

B352:
  store i64 7, ptr %retptr, align 8
  br label %common.ret

B372:
  %.299.pre-phi = phi ptr [ %.pre, %B0.endif.endif.B372_crit_edge ], [ %.190, %B503.peel ], [ %.190, %B503 ]
  %.302 = load i64, ptr %.28, align 8
  %.303 = inttoptr i64 %.302 to ptr
  %.311 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.307, ptr nonnull %excinfo.3, ptr %.299.pre-phi, ptr %.303, i64 %.66)
  switch i32 %.311, label %B372.if.if [
    i32 -2, label %B372.endif
    i32 0, label %B372.endif
  ], !prof !8

B468:
  store i64 0, ptr %.368, align 8
  %.372 = call i32 @_ZN18biped_adrc_kernels7crossedB3v48B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2addd(ptr nonnull %.368, ptr nonnull %excinfo.5, ptr nonnull %arg.r, double %arg.t0, double %arg.t0, double %arg.s)
  %.382 = load i64, ptr %.368, align 8
  %cond5 = icmp eq i32 %.372, 0
  br i1 %cond5, label %B502, label %B468.if.if, !prof !24

B502:
  %"$phi502.0.2.0" = phi i64 [ %.348, %B372.endif.endif ], [ %.382, %B468 ]
  %.409 = load i64, ptr %.28, align 8
  %.410 = inttoptr i64 %.409 to ptr
  %.412 = getelementptr i8, ptr %arg.r, i64 672
  %.413 = load i64, ptr %.412, align 8
  %.414 = inttoptr i64 %.413 to ptr
  %.417 = load i64, ptr %.32, align 8
  %.424 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.420, ptr nonnull %excinfo.6, ptr %.410, ptr %.414, i64 %.417)
  switch i32 %.424, label %B502.if.if [
    i32 -2, label %B502.endif
    i32 0, label %B502.endif
  ], !prof !8

B503:
  %exitcond.not = icmp eq i64 %.66, %.159
  br i1 %exitcond.not, label %B372, label %B196, !llvm.loop !122

B0.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B0.endif.endif:
  %.9.i2 = call i32 @_ZN18biped_adrc_kernels6retakeB3v38B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add(ptr nonnull %.5.i1, ptr nonnull poison, ptr nonnull %arg.r, double %arg.t0, double %arg.s) #0
  %.66 = load i64, ptr %.32, align 8
  %.14677.not = icmp slt i64 %.66, 1
  %.298.pre = load i64, ptr %.24, align 8
  br i1 %.14677.not, label %B0.endif.endif.B372_crit_edge, label %B196.lr.ph

B0.endif.endif.B372_crit_edge:
  %.pre = inttoptr i64 %.298.pre to ptr
  br label %B372

B196.lr.ph:
  %.198 = getelementptr i8, ptr %arg.r, i64 672
  %.190 = inttoptr i64 %.298.pre to ptr
  %.199 = load i64, ptr %.198, align 8
  %.200 = inttoptr i64 %.199 to ptr
  %.193.peel = load double, ptr %.190, align 8
  %.203.peel = load double, ptr %.200, align 8
  %.204.peel = fcmp oeq double %.203.peel, 0.000000e+00
  %.211.peel = fcmp olt double %.193.peel, 0.000000e+00
  %or.cond.peel = select i1 %.204.peel, i1 %.211.peel, i1 false
  br i1 %or.cond.peel, label %B278.peel, label %B503.peel

B278.peel:
  %.225.peel = load i64, ptr %.28, align 8
  %.226.peel = inttoptr i64 %.225.peel to ptr
  %.229.peel = load double, ptr %.226.peel, align 8
  %.230.peel = fmul double %.229.peel, 3.000000e+00
  %.232.peel = fcmp olt double %.193.peel, %.230.peel
  br i1 %.232.peel, label %_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd.exit.peel, label %B503.peel

_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd.exit.peel:
  %sunkaddr19 = getelementptr i8, ptr %.190, i64 24
  %.19.i.peel = load double, ptr %sunkaddr19, align 8, !noalias !124
  %sunkaddr20 = getelementptr i8, ptr %arg.r, i64 240
  %.23.i.peel = load double, ptr %sunkaddr20, align 8, !noalias !124
  %.26.i.peel = fcmp ule double %.19.i.peel, %.23.i.peel
  br i1 %.26.i.peel, label %B503.peel, label %B352

B503.peel:
  %exitcond.not.peel = icmp eq i64 %.66, 1
  br i1 %exitcond.not.peel, label %B372, label %B196

B372.endif:
  store i64 0, ptr %.334, align 8
  %.338 = call i32 @_ZN18biped_adrc_kernels7overdueB3v45B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad(ptr nonnull %.334, ptr nonnull %excinfo.4, ptr nonnull %arg.r, double %arg.t0)
  %cond = icmp eq i32 %.338, 0
  br i1 %cond, label %B372.endif.endif, label %B372.endif.if.if, !prof !24

B372.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B372.endif.endif:
  %.348 = load i64, ptr %.334, align 8
  %.358.not = icmp eq i64 %.348, 0
  br i1 %.358.not, label %B468, label %B502

B372.endif.if.if:
  %.346 = icmp sgt i32 %.338, 0
  %.339 = load ptr, ptr %excinfo.4, align 8
  %.347 = select i1 %.346, ptr %.339, ptr undef
  store ptr %.347, ptr %excinfo, align 8
  br label %common.ret

B468.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B502.endif:
  store i64 %"$phi502.0.2.0", ptr %retptr, align 8
  br label %common.ret

B502.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret
}

define linkonce_odr i32 @_ZN18biped_adrc_kernels7crossedB3v48B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2addd(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr %arg.r, double %arg.t0, double %arg.ta, double %arg.tb) local_unnamed_addr {
B0.endif:
  %.26 = getelementptr i8, ptr %arg.r, i64 136
  %.27 = load i64, ptr %.26, align 8
  %.109138.not = icmp slt i64 %.27, 1
  br i1 %.109138.not, label %common.ret, label %B78.preheader

B78.preheader:
  %sunkaddr67 = getelementptr i8, ptr %arg.r, i64 672
  %sunkaddr = getelementptr i8, ptr %arg.r, i64 680
  %sunkaddr68 = getelementptr i8, ptr %arg.r, i64 768
  %sunkaddr69 = getelementptr i8, ptr %arg.r, i64 80
  %sunkaddr70 = getelementptr i8, ptr %arg.r, i64 688
  %sunkaddr71 = getelementptr i8, ptr %arg.r, i64 240
  br label %B78

B78:
  %first.3.0143 = phi double [ 0x7FF0000000000000, %B78.preheader ], [ %first.3.0143.be, %B78.backedge ]
  %first_guard.2.0142 = phi i64 [ -1, %B78.preheader ], [ %first_guard.2.0142.be, %B78.backedge ]
  %last.2.0141 = phi i64 [ -1, %B78.preheader ], [ %last.2.0141.be, %B78.backedge ]
  %.115135139 = phi i64 [ 0, %B78.preheader ], [ %.115135139.be, %B78.backedge ]
  %.122 = add nuw nsw i64 %.115135139, 1
  %.152 = load i64, ptr %sunkaddr67, align 8
  %.153 = inttoptr i64 %.152 to ptr
  %.155 = getelementptr double, ptr %.153, i64 %.115135139
  %.156 = load double, ptr %.155, align 8
  %.157 = fcmp ogt double %.156, 0.000000e+00
  br i1 %.157, label %B118, label %B407

B118:
  %.178 = load i64, ptr %sunkaddr, align 8
  %.179 = inttoptr i64 %.178 to ptr
  %.181 = getelementptr double, ptr %.179, i64 %.115135139
  %.182 = load double, ptr %.181, align 8
  %.184 = fcmp ugt double %.182, 0.000000e+00
  br i1 %.184, label %B407, label %B156

B156:
  %.223 = tail call double @locate(ptr nonnull %arg.r, i64 %.115135139, double %arg.t0, double %arg.ta, double %arg.tb)
  %.234 = load i64, ptr %sunkaddr68, align 8
  %.238 = load i64, ptr %sunkaddr69, align 8
  %.9240.not.i = icmp slt i64 %.238, 1
  br i1 %.9240.not.i, label %B284, label %iter.check.i

iter.check.i:
  %min.iters.check.i = icmp samesign ult i64 %.238, 4
  br i1 %min.iters.check.i, label %iter.check.i.B40.i.preheader_crit_edge, label %vector.main.loop.iter.check.i

iter.check.i.B40.i.preheader_crit_edge:
  %.pre = inttoptr i64 %.234 to ptr
  br label %B40.i.preheader

vector.main.loop.iter.check.i:
  %min.iters.check1.i = icmp samesign ult i64 %.238, 16
  br i1 %min.iters.check1.i, label %vector.main.loop.iter.check.i.vec.epilog.ph.i_crit_edge, label %vector.ph.i

vector.main.loop.iter.check.i.vec.epilog.ph.i_crit_edge:
  %.pre44 = inttoptr i64 %.234 to ptr
  br label %vec.epilog.ph.i

vector.ph.i:
  %n.vec.i = and i64 %.238, 9223372036854775792
  %0 = inttoptr i64 %.234 to ptr
  br label %vector.body.i

vector.body.i:
  %index.i = phi i64 [ 0, %vector.ph.i ], [ %index.next.i, %vector.body.i ]
  %vec.phi.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %9, %vector.body.i ]
  %vec.phi2.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %10, %vector.body.i ]
  %vec.phi3.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %11, %vector.body.i ]
  %vec.phi4.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %12, %vector.body.i ]
  %sunkaddr50 = shl i64 %index.i, 3
  %sunkaddr51 = getelementptr i8, ptr %0, i64 %sunkaddr50
  %wide.load.i = load <4 x double>, ptr %sunkaddr51, align 8, !noalias !127
  %sunkaddr55 = getelementptr i8, ptr %sunkaddr51, i64 32
  %wide.load5.i = load <4 x double>, ptr %sunkaddr55, align 8, !noalias !127
  %sunkaddr59 = getelementptr i8, ptr %sunkaddr51, i64 64
  %wide.load6.i = load <4 x double>, ptr %sunkaddr59, align 8, !noalias !127
  %scevgep66 = getelementptr i8, ptr %sunkaddr51, i64 96
  %wide.load7.i = load <4 x double>, ptr %scevgep66, align 8, !noalias !127
  %1 = tail call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load.i)
  %2 = fcmp one <4 x double> %1, splat (double 0x7FF0000000000000)
  %3 = tail call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load5.i)
  %4 = fcmp one <4 x double> %3, splat (double 0x7FF0000000000000)
  %5 = tail call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load6.i)
  %6 = fcmp one <4 x double> %5, splat (double 0x7FF0000000000000)
  %7 = tail call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load7.i)
  %8 = fcmp one <4 x double> %7, splat (double 0x7FF0000000000000)
  %9 = and <4 x i1> %vec.phi.i, %2
  %10 = and <4 x i1> %vec.phi2.i, %4
  %11 = and <4 x i1> %vec.phi3.i, %6
  %12 = and <4 x i1> %vec.phi4.i, %8
  %index.next.i = add nuw nsw i64 %index.i, 16
  %13 = icmp eq i64 %n.vec.i, %index.next.i
  br i1 %13, label %middle.block.i, label %vector.body.i, !llvm.loop !130

middle.block.i:
  %bin.rdx.i = and <4 x i1> %9, %10
  %bin.rdx8.i = and <4 x i1> %11, %bin.rdx.i
  %bin.rdx9.i = and <4 x i1> %12, %bin.rdx8.i
  %14 = bitcast <4 x i1> %bin.rdx9.i to i4
  %15 = icmp eq i4 %14, -1
  %cmp.n.i = icmp eq i64 %.238, %n.vec.i
  br i1 %cmp.n.i, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit, label %vec.epilog.iter.check.i

vec.epilog.iter.check.i:
  %16 = and i64 %.238, 12
  %min.epilog.iters.check.i = icmp eq i64 %16, 0
  br i1 %min.epilog.iters.check.i, label %B40.i.preheader, label %vec.epilog.ph.i, !prof !20

vec.epilog.ph.i:
  %.pre-phi45 = phi ptr [ %.pre44, %vector.main.loop.iter.check.i.vec.epilog.ph.i_crit_edge ], [ %0, %vec.epilog.iter.check.i ]
  %vec.epilog.resume.val.i = phi i64 [ 0, %vector.main.loop.iter.check.i.vec.epilog.ph.i_crit_edge ], [ %n.vec.i, %vec.epilog.iter.check.i ]
  %bc.merge.rdx.i = phi i1 [ true, %vector.main.loop.iter.check.i.vec.epilog.ph.i_crit_edge ], [ %15, %vec.epilog.iter.check.i ]
  %n.vec11.i = and i64 %.238, 9223372036854775804
  %17 = insertelement <4 x i1> <i1 poison, i1 true, i1 true, i1 true>, i1 %bc.merge.rdx.i, i64 0
  br label %vec.epilog.vector.body.i

vec.epilog.vector.body.i:
  %index12.i = phi i64 [ %vec.epilog.resume.val.i, %vec.epilog.ph.i ], [ %index.next15.i, %vec.epilog.vector.body.i ]
  %vec.phi13.i = phi <4 x i1> [ %17, %vec.epilog.ph.i ], [ %21, %vec.epilog.vector.body.i ]
  %18 = shl i64 %index12.i, 3
  %scevgep28.i = getelementptr i8, ptr %.pre-phi45, i64 %18
  %wide.load14.i = load <4 x double>, ptr %scevgep28.i, align 8, !noalias !127
  %19 = tail call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load14.i)
  %20 = fcmp one <4 x double> %19, splat (double 0x7FF0000000000000)
  %21 = and <4 x i1> %vec.phi13.i, %20
  %index.next15.i = add nuw i64 %index12.i, 4
  %22 = icmp eq i64 %n.vec11.i, %index.next15.i
  br i1 %22, label %vec.epilog.middle.block.i, label %vec.epilog.vector.body.i, !llvm.loop !131

vec.epilog.middle.block.i:
  %23 = bitcast <4 x i1> %21 to i4
  %24 = icmp eq i4 %23, -1
  %cmp.n16.i = icmp eq i64 %.238, %n.vec11.i
  br i1 %cmp.n16.i, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit, label %B40.i.preheader

B40.i.preheader:
  %.pre-phi = phi ptr [ %.pre, %iter.check.i.B40.i.preheader_crit_edge ], [ %0, %vec.epilog.iter.check.i ], [ %.pre-phi45, %vec.epilog.middle.block.i ]
  %good.2.043.i.ph = phi i1 [ true, %iter.check.i.B40.i.preheader_crit_edge ], [ %15, %vec.epilog.iter.check.i ], [ %24, %vec.epilog.middle.block.i ]
  %.983941.i.ph = phi i64 [ 0, %iter.check.i.B40.i.preheader_crit_edge ], [ %n.vec.i, %vec.epilog.iter.check.i ], [ %n.vec11.i, %vec.epilog.middle.block.i ]
  br label %B40.i

B40.i:
  %good.2.043.i = phi i1 [ %.136.i, %B40.i ], [ %good.2.043.i.ph, %B40.i.preheader ]
  %.983941.i = phi i64 [ %.105.i, %B40.i ], [ %.983941.i.ph, %B40.i.preheader ]
  %.105.i = add nuw nsw i64 %.983941.i, 1
  %25 = shl i64 %.983941.i, 3
  %scevgep.i = getelementptr i8, ptr %.pre-phi, i64 %25
  %.132.i = load double, ptr %scevgep.i, align 8, !noalias !127
  %26 = tail call double @llvm.fabs.f64(double %.132.i)
  %27 = fcmp one double %26, 0x7FF0000000000000
  %.136.i = and i1 %good.2.043.i, %27
  %exitcond.not.i = icmp eq i64 %.238, %.105.i
  br i1 %exitcond.not.i, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit, label %B40.i, !llvm.loop !132

_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit:
  %.136.lcssa.i = phi i1 [ %24, %vec.epilog.middle.block.i ], [ %15, %middle.block.i ], [ %.136.i, %B40.i ]
  br i1 %.136.lcssa.i, label %B284, label %B250.endif

B284:
  %.332 = fcmp olt double %.223, %first.3.0143
  br i1 %.332, label %B296, label %B407

B296:
  %.9.not.i = icmp eq i64 %.115135139, 0
  br i1 %.9.not.i, label %_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd.exit, label %B407

_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd.exit:
  %.16.i = load i64, ptr %sunkaddr70, align 8, !noalias !133
  %.17.i = inttoptr i64 %.16.i to ptr
  %.18.i = getelementptr i8, ptr %.17.i, i64 24
  %.19.i = load double, ptr %.18.i, align 8, !noalias !133
  %.23.i = load double, ptr %sunkaddr71, align 8, !noalias !133
  %.26.i = fcmp ule double %.19.i, %.23.i
  %cond.fr = freeze i1 %.26.i
  br i1 %cond.fr, label %B407, label %B407.thread

B340:
  %.432 = icmp slt i64 %first_guard.3.1.fr, 0
  br i1 %.432, label %common.ret, label %B356

common.ret:
  %switch.select8.i.sink = phi i64 [ 0, %B340 ], [ %spec.select.i, %B250.endif ], [ 0, %B0.endif ], [ 9, %30 ], [ %29, %B406.endif ]
  store i64 %switch.select8.i.sink, ptr %retptr, align 8
  ret i32 0

B356:
  %28 = icmp eq i64 %first_guard.3.1.fr, %last.3.1
  br i1 %28, label %B406.endif, label %B368

B368:
  %.467 = tail call double @locate(ptr nonnull %arg.r, i64 %first_guard.3.1.fr, double %arg.t0, double %arg.ta, double %arg.tb)
  br label %B406.endif

B407:
  %last.3.1 = phi i64 [ %last.2.0141, %B78 ], [ %last.2.0141, %B118 ], [ %.115135139, %B284 ], [ %.115135139, %B296 ], [ 0, %_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd.exit ]
  %first_guard.3.1 = phi i64 [ %first_guard.2.0142, %B78 ], [ %first_guard.2.0142, %B118 ], [ %first_guard.2.0142, %B284 ], [ %.115135139, %B296 ], [ %first_guard.2.0142, %_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd.exit ]
  %first.4.1 = phi double [ %first.3.0143, %B78 ], [ %first.3.0143, %B118 ], [ %first.3.0143, %B284 ], [ %.223, %B296 ], [ %first.3.0143, %_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd.exit ]
  %first_guard.3.1.fr = freeze i64 %first_guard.3.1
  %exitcond.not = icmp eq i64 %.122, %.27
  br i1 %exitcond.not, label %B340, label %B78.backedge

B78.backedge:
  %first.3.0143.be = phi double [ %first.4.1, %B407 ], [ %.223, %B407.thread ]
  %first_guard.2.0142.be = phi i64 [ %first_guard.3.1.fr, %B407 ], [ 0, %B407.thread ]
  %last.2.0141.be = phi i64 [ %last.3.1, %B407 ], [ 0, %B407.thread ]
  %.115135139.be = phi i64 [ %.122, %B407 ], [ 1, %B407.thread ]
  br label %B78

B407.thread:
  %exitcond.not8 = icmp eq i64 %.122, %.27
  br i1 %exitcond.not8, label %.thread, label %B78.backedge

.thread:
  %.48527 = getelementptr i8, ptr %arg.r, i64 520
  store double %.223, ptr %.48527, align 8
  br label %30

B250.endif:
  %.8.i = getelementptr i8, ptr %arg.r, i64 496
  %.9.i = load i64, ptr %.8.i, align 8, !noalias !136
  %.10.i = icmp eq i64 %.9.i, 0
  %spec.select.i = select i1 %.10.i, i64 4, i64 %.9.i
  br label %common.ret

B406.endif:
  %first.6.0 = phi double [ %.467, %B368 ], [ %first.4.1, %B356 ]
  %.485 = getelementptr i8, ptr %arg.r, i64 520
  store double %first.6.0, ptr %.485, align 8
  %switch.selectcmp.i = icmp eq i64 %first_guard.3.1.fr, 1
  %29 = select i1 %switch.selectcmp.i, i64 2, i64 3
  %switch.selectcmp7.i = icmp eq i64 %first_guard.3.1.fr, 0
  br i1 %switch.selectcmp7.i, label %30, label %common.ret

30:
  br label %common.ret
}

define linkonce_odr i32 @_ZN18biped_adrc_kernels7overdueB3v45B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r, double %arg.t0) local_unnamed_addr {
B0:
  %.22 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.12 = getelementptr i8, ptr %arg.r, i64 696
  %.13 = load i64, ptr %.12, align 8
  %.14 = inttoptr i64 %.13 to ptr
  %.16 = getelementptr i8, ptr %arg.r, i64 768
  %.17 = load i64, ptr %.16, align 8
  %.18 = inttoptr i64 %.17 to ptr
  %.20 = getelementptr i8, ptr %arg.r, i64 80
  %.21 = load i64, ptr %.20, align 8
  %.26 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.22, ptr nonnull %excinfo.1, ptr %.14, ptr %.18, i64 %.21)
  switch i32 %.26, label %B0.if.if [
    i32 -2, label %B0.endif.endif
    i32 0, label %B0.endif.endif
  ], !prof !8

B166:
  %lsr.iv = phi i64 [ 0, %B166.preheader ], [ %lsr.iv.next, %B420 ]
  %.204.not = icmp eq i64 %2, %lsr.iv
  br i1 %.204.not, label %B420, label %B244

B244:
  %.184 = load i64, ptr %sunkaddr9, align 8
  %.185 = inttoptr i64 %.184 to ptr
  %scevgep = getelementptr i8, ptr %.185, i64 8
  %0 = shl i64 %lsr.iv, 3
  %scevgep18 = getelementptr i8, ptr %scevgep, i64 %0
  %.188 = load double, ptr %scevgep18, align 8
  %.191 = load i64, ptr %sunkaddr, align 8
  %.192 = inttoptr i64 %.191 to ptr
  %scevgep19 = getelementptr i8, ptr %.192, i64 8
  %scevgep8 = getelementptr i8, ptr %scevgep19, i64 %0
  %.195 = load double, ptr %scevgep8, align 8
  %.218 = fcmp ole double %.188, 0.000000e+00
  %.230 = fcmp ogt double %.188, %.195
  %or.cond = select i1 %.218, i1 %.230, i1 false
  br i1 %or.cond, label %B370.endif.loopexit, label %B420

B420:
  %lsr.iv.next = add nuw i64 %lsr.iv, 1
  %1 = add i64 %lsr.iv, 2
  %exitcond.not = icmp eq i64 %.61, %1
  br i1 %exitcond.not, label %B422, label %B166, !llvm.loop !139

common.ret:
  %common.ret.op = phi i32 [ 0, %B422 ], [ %.26, %B0.if.if ], [ 0, %B370.endif ]
  ret i32 %common.ret.op

B422:
  store i64 0, ptr %retptr, align 8
  br label %common.ret

B0.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B0.endif.endif:
  %.50 = load i64, ptr %.16, align 8
  %.51 = inttoptr i64 %.50 to ptr
  %.53 = getelementptr i8, ptr %arg.r, i64 688
  %.54 = load i64, ptr %.53, align 8
  %.55 = inttoptr i64 %.54 to ptr
  %.58 = tail call ptr @watch(ptr nonnull %arg.r, double %arg.t0, ptr %.51, ptr %.55)
  %.60 = getelementptr i8, ptr %arg.r, i64 136
  %.61 = load i64, ptr %.60, align 8
  %.14185.not = icmp slt i64 %.61, 1
  br i1 %.14185.not, label %B422, label %B166.lr.ph

B166.lr.ph:
  %.201 = getelementptr i8, ptr %arg.r, i64 384
  %.202 = load i64, ptr %.201, align 8
  %.204.not.peel = icmp eq i64 %.202, 0
  br i1 %.204.not.peel, label %B420.peel, label %B244.peel

B244.peel:
  %sunkaddr23 = getelementptr i8, ptr %arg.r, i64 672
  %.184.peel = load i64, ptr %sunkaddr23, align 8
  %.185.peel = inttoptr i64 %.184.peel to ptr
  %.188.peel = load double, ptr %.185.peel, align 8
  %sunkaddr24 = getelementptr i8, ptr %arg.r, i64 680
  %.191.peel = load i64, ptr %sunkaddr24, align 8
  %.192.peel = inttoptr i64 %.191.peel to ptr
  %.195.peel = load double, ptr %.192.peel, align 8
  %.218.peel = fcmp ole double %.188.peel, 0.000000e+00
  %.230.peel = fcmp ogt double %.188.peel, %.195.peel
  %or.cond.peel = select i1 %.218.peel, i1 %.230.peel, i1 false
  br i1 %or.cond.peel, label %_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd.exit.peel, label %B420.peel

_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd.exit.peel:
  %.16.i.peel = load i64, ptr %.53, align 8, !noalias !140
  %.17.i.peel = inttoptr i64 %.16.i.peel to ptr
  %.18.i.peel = getelementptr i8, ptr %.17.i.peel, i64 24
  %.19.i.peel = load double, ptr %.18.i.peel, align 8, !noalias !140
  %sunkaddr26 = getelementptr i8, ptr %arg.r, i64 240
  %.23.i.peel = load double, ptr %sunkaddr26, align 8, !noalias !140
  %.26.i.peel = fcmp ule double %.19.i.peel, %.23.i.peel
  br i1 %.26.i.peel, label %B420.peel, label %B370.endif

B420.peel:
  %exitcond.not.peel = icmp eq i64 %.61, 1
  br i1 %exitcond.not.peel, label %B422, label %B166.preheader

B166.preheader:
  %2 = add i64 %.202, -1
  %sunkaddr9 = getelementptr i8, ptr %arg.r, i64 672
  %sunkaddr = getelementptr i8, ptr %arg.r, i64 680
  br label %B166

B370.endif.loopexit:
  %3 = icmp eq i64 %lsr.iv, 0
  %4 = select i1 %3, i64 2, i64 3
  br label %B370.endif

B370.endif:
  %.9.not.i.lcssa = phi i64 [ %4, %B370.endif.loopexit ], [ 9, %_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd.exit.peel ]
  %.330 = getelementptr i8, ptr %arg.r, i64 520
  store double %arg.t0, ptr %.330, align 8
  store i64 %.9.not.i.lcssa, ptr %retptr, align 8
  br label %common.ret
}


define i64 @lift(ptr %.1, double %.2, double %.3) local_unnamed_addr #0 {
entry:
  %.5 = alloca i64, align 8
  store i64 0, ptr %.5, align 8
  %excinfo = alloca ptr, align 8
  %.9 = call i32 @_ZN18biped_adrc_kernels4liftB3v43B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add(ptr nonnull %.5, ptr nonnull %excinfo, ptr %.1, double %.2, double %.3) #0
  %cond = icmp eq i32 %.9, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.19 = load i64, ptr %.5, align 8
  ret i64 %.19
}

define i32 @_ZN18biped_adrc_kernels5eventB3v50B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r, double %arg.t0, double %arg.t1) local_unnamed_addr {
B0.endif:
  %.5.i = alloca ptr, align 8
  %.181 = alloca i8, align 1
  %excinfo.4 = alloca ptr, align 8
  store ptr null, ptr %excinfo.4, align 8
  %.237 = alloca ptr, align 8
  %excinfo.5 = alloca ptr, align 8
  %.445 = alloca ptr, align 8
  %excinfo.6 = alloca ptr, align 8
  %.490 = alloca i64, align 8
  store i64 0, ptr %.490, align 8
  %excinfo.7 = alloca ptr, align 8
  %.531 = alloca ptr, align 8
  %excinfo.8 = alloca ptr, align 8
  %.6.i = fsub double %arg.t1, %arg.t0
  %.10.i = fdiv double %.6.i, 2.000000e-03
  %.11.i = fadd double %.10.i, -1.000000e-09
  %.12.i = tail call double @llvm.ceil.f64(double %.11.i)
  %.13.i = fptosi double %.12.i to i64
  %.13.i.i = tail call i64 @llvm.smax.i64(i64 %.13.i, i64 1)
  %.54 = getelementptr i8, ptr %arg.r, i64 376
  %.56 = load double, ptr %.54, align 8
  %.58 = fcmp oeq double %arg.t0, %.56
  br i1 %.58, label %B62, label %B190

B62:
  %.11.i6 = getelementptr i8, ptr %arg.r, i64 136
  %.12.i7 = load i64, ptr %.11.i6, align 8, !noalias !143
  %.9443.not.i = icmp slt i64 %.12.i7, 1
  br i1 %.9443.not.i, label %B190, label %B50.lr.ph.i

B50.lr.ph.i:
  %xtraiter.i = and i64 %.12.i7, 7
  %0 = icmp samesign ult i64 %.12.i7, 8
  br i1 %0, label %B50.epil.preheader.i, label %B50.lr.ph.new.i

B50.lr.ph.new.i:
  %unroll_iter.i = and i64 %.12.i7, 9223372036854775800
  %1 = add nsw i64 %.12.i7, -8
  %2 = lshr i64 %1, 3
  %3 = icmp eq i64 %2, 0
  br i1 %3, label %B56.i.epil, label %B50.lr.ph.new.i.new

B50.lr.ph.new.i.new:
  %4 = add nuw nsw i64 %2, 1
  %unroll_iter = and i64 %4, 4611686018427387902
  %sunkaddr = getelementptr i8, ptr %arg.r, i64 672
  br label %B50.i

B50.i:
  %lsr.iv = phi i64 [ %lsr.iv.next, %B88.7.i.1 ], [ %unroll_iter, %B50.lr.ph.new.i.new ]
  %low.2.046.i = phi i1 [ %"$phi88.1.2.1.7.i.1", %B88.7.i.1 ], [ false, %B50.lr.ph.new.i.new ]
  %.1004244.i = phi i64 [ %.107.73.i.1, %B88.7.i.1 ], [ 0, %B50.lr.ph.new.i.new ]
  br i1 %low.2.046.i, label %B88.7.i.1, label %B56.i

B56.i:
  %.145.i = load i64, ptr %sunkaddr, align 8, !noalias !143
  %.146.i = inttoptr i64 %.145.i to ptr
  %5 = shl i64 %.1004244.i, 3
  %scevgep87 = getelementptr i8, ptr %.146.i, i64 56
  %scevgep88 = getelementptr i8, ptr %scevgep87, i64 %5
  %scevgep89 = getelementptr i8, ptr %scevgep88, i64 -56
  %.149.i = load double, ptr %scevgep89, align 8, !noalias !143
  %.152.i = fcmp ugt double %.149.i, 0.000000e+00
  br i1 %.152.i, label %B56.1.i, label %B88.7.i.1

B56.1.i:
  %scevgep86 = getelementptr i8, ptr %scevgep88, i64 -48
  %.149.1.i = load double, ptr %scevgep86, align 8, !noalias !143
  %.152.1.i = fcmp ugt double %.149.1.i, 0.000000e+00
  br i1 %.152.1.i, label %B56.2.i, label %B88.7.i.1

B56.2.i:
  %scevgep83 = getelementptr i8, ptr %scevgep88, i64 -40
  %.149.2.i = load double, ptr %scevgep83, align 8, !noalias !143
  %.152.2.i = fcmp ugt double %.149.2.i, 0.000000e+00
  br i1 %.152.2.i, label %B56.3.i, label %B88.7.i.1

B56.3.i:
  %scevgep80 = getelementptr i8, ptr %scevgep88, i64 -32
  %.149.3.i = load double, ptr %scevgep80, align 8, !noalias !143
  %.152.3.i = fcmp ugt double %.149.3.i, 0.000000e+00
  br i1 %.152.3.i, label %B56.4.i, label %B88.7.i.1

B56.4.i:
  %scevgep77 = getelementptr i8, ptr %scevgep88, i64 -24
  %.149.4.i = load double, ptr %scevgep77, align 8, !noalias !143
  %.152.4.i = fcmp ugt double %.149.4.i, 0.000000e+00
  br i1 %.152.4.i, label %B56.5.i, label %B88.7.i.1

B56.5.i:
  %scevgep74 = getelementptr i8, ptr %scevgep88, i64 -16
  %.149.5.i = load double, ptr %scevgep74, align 8, !noalias !143
  %.152.5.i = fcmp ugt double %.149.5.i, 0.000000e+00
  br i1 %.152.5.i, label %B88.6.i, label %B88.7.i.1

B88.6.i:
  %scevgep71 = getelementptr i8, ptr %scevgep88, i64 -8
  %.149.6.i = load double, ptr %scevgep71, align 8, !noalias !143
  %.152.6.i = fcmp ugt double %.149.6.i, 0.000000e+00
  br i1 %.152.6.i, label %B56.7.i, label %B88.7.i.1

B56.7.i:
  %.149.7.i = load double, ptr %scevgep88, align 8, !noalias !143
  %.152.7.i = fcmp ugt double %.149.7.i, 0.000000e+00
  br i1 %.152.7.i, label %B56.i.1, label %B88.7.i.1

B56.i.1:
  %scevgep = getelementptr i8, ptr %.146.i, i64 120
  %scevgep46 = getelementptr i8, ptr %scevgep, i64 %5
  %scevgep47 = getelementptr i8, ptr %scevgep46, i64 -56
  %.149.i.1 = load double, ptr %scevgep47, align 8, !noalias !143
  %.152.i.1 = fcmp ugt double %.149.i.1, 0.000000e+00
  br i1 %.152.i.1, label %B56.1.i.1, label %B88.7.i.1

B56.1.i.1:
  %scevgep50 = getelementptr i8, ptr %scevgep46, i64 -48
  %.149.1.i.1 = load double, ptr %scevgep50, align 8, !noalias !143
  %.152.1.i.1 = fcmp ugt double %.149.1.i.1, 0.000000e+00
  br i1 %.152.1.i.1, label %B56.2.i.1, label %B88.7.i.1

B56.2.i.1:
  %scevgep53 = getelementptr i8, ptr %scevgep46, i64 -40
  %.149.2.i.1 = load double, ptr %scevgep53, align 8, !noalias !143
  %.152.2.i.1 = fcmp ugt double %.149.2.i.1, 0.000000e+00
  br i1 %.152.2.i.1, label %B56.3.i.1, label %B88.7.i.1

B56.3.i.1:
  %scevgep56 = getelementptr i8, ptr %scevgep46, i64 -32
  %.149.3.i.1 = load double, ptr %scevgep56, align 8, !noalias !143
  %.152.3.i.1 = fcmp ugt double %.149.3.i.1, 0.000000e+00
  br i1 %.152.3.i.1, label %B56.4.i.1, label %B88.7.i.1

B56.4.i.1:
  %scevgep59 = getelementptr i8, ptr %scevgep46, i64 -24
  %.149.4.i.1 = load double, ptr %scevgep59, align 8, !noalias !143
  %.152.4.i.1 = fcmp ugt double %.149.4.i.1, 0.000000e+00
  br i1 %.152.4.i.1, label %B56.5.i.1, label %B88.7.i.1

B56.5.i.1:
  %scevgep62 = getelementptr i8, ptr %scevgep46, i64 -16
  %.149.5.i.1 = load double, ptr %scevgep62, align 8, !noalias !143
  %.152.5.i.1 = fcmp ugt double %.149.5.i.1, 0.000000e+00
  br i1 %.152.5.i.1, label %B88.6.i.1, label %B88.7.i.1

B88.6.i.1:
  %scevgep65 = getelementptr i8, ptr %scevgep46, i64 -8
  %.149.6.i.1 = load double, ptr %scevgep65, align 8, !noalias !143
  %.152.6.i.1 = fcmp ugt double %.149.6.i.1, 0.000000e+00
  br i1 %.152.6.i.1, label %B56.7.i.1, label %B88.7.i.1

B56.7.i.1:
  %.149.7.i.1 = load double, ptr %scevgep46, align 8, !noalias !143
  %.152.7.i.1 = fcmp ole double %.149.7.i.1, 0.000000e+00
  br label %B88.7.i.1

B88.7.i.1:
  %"$phi88.1.2.1.7.i.1" = phi i1 [ true, %B88.6.i.1 ], [ %.152.7.i.1, %B56.7.i.1 ], [ true, %B56.5.i.1 ], [ true, %B56.3.i.1 ], [ true, %B56.1.i.1 ], [ true, %B56.7.i ], [ true, %B56.i.1 ], [ true, %B56.2.i.1 ], [ true, %B56.4.i.1 ], [ true, %B56.4.i ], [ true, %B56.2.i ], [ true, %B56.i ], [ true, %B50.i ], [ true, %B56.1.i ], [ true, %B56.3.i ], [ true, %B56.5.i ], [ true, %B88.6.i ]
  %.107.73.i.1 = add nuw i64 %.1004244.i, 16
  %lsr.iv.next = add i64 %lsr.iv, -2
  %niter.ncmp.1 = icmp eq i64 %lsr.iv.next, 0
  br i1 %niter.ncmp.1, label %B92.loopexit.unr-lcssa.i.unr-lcssa, label %B50.i

B92.loopexit.unr-lcssa.i.unr-lcssa:
  %6 = and i64 %1, 8
  %lcmp.mod.not.not = icmp ne i64 %6, 0
  %brmerge = select i1 %lcmp.mod.not.not, i1 true, i1 %"$phi88.1.2.1.7.i.1"
  %not.lcmp.mod.not.not = xor i1 %lcmp.mod.not.not, true
  %"$phi88.1.2.1.7.i.1.mux" = select i1 %not.lcmp.mod.not.not, i1 true, i1 %"$phi88.1.2.1.7.i.1"
  br i1 %brmerge, label %B92.loopexit.unr-lcssa.i, label %B56.i.epil

B56.i.epil:
  %.1004244.i.epil.init3 = phi i64 [ %.107.73.i.1, %B92.loopexit.unr-lcssa.i.unr-lcssa ], [ 0, %B50.lr.ph.new.i ]
  %sunkaddr91 = getelementptr i8, ptr %arg.r, i64 672
  %.145.i.epil = load i64, ptr %sunkaddr91, align 8, !noalias !143
  %.146.i.epil = inttoptr i64 %.145.i.epil to ptr
  %7 = shl i64 %.1004244.i.epil.init3, 3
  %scevgep17.i.epil = getelementptr i8, ptr %.146.i.epil, i64 %7
  %.149.i.epil = load double, ptr %scevgep17.i.epil, align 8, !noalias !143
  %.152.i.epil = fcmp ugt double %.149.i.epil, 0.000000e+00
  br i1 %.152.i.epil, label %B56.1.i.epil, label %B92.loopexit.unr-lcssa.i

B56.1.i.epil:
  %sunkaddr95 = getelementptr i8, ptr %scevgep17.i.epil, i64 8
  %.149.1.i.epil = load double, ptr %sunkaddr95, align 8, !noalias !143
  %.152.1.i.epil = fcmp ugt double %.149.1.i.epil, 0.000000e+00
  br i1 %.152.1.i.epil, label %B56.2.i.epil, label %B92.loopexit.unr-lcssa.i

B56.2.i.epil:
  %sunkaddr99 = getelementptr i8, ptr %scevgep17.i.epil, i64 16
  %.149.2.i.epil = load double, ptr %sunkaddr99, align 8, !noalias !143
  %.152.2.i.epil = fcmp ugt double %.149.2.i.epil, 0.000000e+00
  br i1 %.152.2.i.epil, label %B56.3.i.epil, label %B92.loopexit.unr-lcssa.i

B56.3.i.epil:
  %sunkaddr103 = getelementptr i8, ptr %scevgep17.i.epil, i64 24
  %.149.3.i.epil = load double, ptr %sunkaddr103, align 8, !noalias !143
  %.152.3.i.epil = fcmp ugt double %.149.3.i.epil, 0.000000e+00
  br i1 %.152.3.i.epil, label %B56.4.i.epil, label %B92.loopexit.unr-lcssa.i

B56.4.i.epil:
  %sunkaddr107 = getelementptr i8, ptr %scevgep17.i.epil, i64 32
  %.149.4.i.epil = load double, ptr %sunkaddr107, align 8, !noalias !143
  %.152.4.i.epil = fcmp ugt double %.149.4.i.epil, 0.000000e+00
  br i1 %.152.4.i.epil, label %B56.5.i.epil, label %B92.loopexit.unr-lcssa.i

B56.5.i.epil:
  %sunkaddr111 = getelementptr i8, ptr %scevgep17.i.epil, i64 40
  %.149.5.i.epil = load double, ptr %sunkaddr111, align 8, !noalias !143
  %.152.5.i.epil = fcmp ugt double %.149.5.i.epil, 0.000000e+00
  br i1 %.152.5.i.epil, label %B88.6.i.epil, label %B92.loopexit.unr-lcssa.i

B88.6.i.epil:
  %sunkaddr115 = getelementptr i8, ptr %scevgep17.i.epil, i64 48
  %.149.6.i.epil = load double, ptr %sunkaddr115, align 8, !noalias !143
  %.152.6.i.epil = fcmp ugt double %.149.6.i.epil, 0.000000e+00
  br i1 %.152.6.i.epil, label %B56.7.i.epil, label %B92.loopexit.unr-lcssa.i

B56.7.i.epil:
  %sunkaddr119 = getelementptr i8, ptr %scevgep17.i.epil, i64 56
  %.149.7.i.epil = load double, ptr %sunkaddr119, align 8, !noalias !143
  %.152.7.i.epil = fcmp ole double %.149.7.i.epil, 0.000000e+00
  br label %B92.loopexit.unr-lcssa.i

B92.loopexit.unr-lcssa.i:
  %"$phi88.1.2.1.7.i.lcssa" = phi i1 [ %"$phi88.1.2.1.7.i.1.mux", %B92.loopexit.unr-lcssa.i.unr-lcssa ], [ true, %B88.6.i.epil ], [ %.152.7.i.epil, %B56.7.i.epil ], [ true, %B56.5.i.epil ], [ true, %B56.3.i.epil ], [ true, %B56.1.i.epil ], [ true, %B56.4.i.epil ], [ true, %B56.i.epil ], [ true, %B56.2.i.epil ]
  %lcmp.mod.not.i = icmp eq i64 %xtraiter.i, 0
  br i1 %lcmp.mod.not.i, label %_ZN18biped_adrc_kernels10begins_lowB3v53B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a.exit, label %B50.epil.preheader.i

B50.epil.preheader.i:
  %low.2.046.epil.init.i = phi i1 [ false, %B50.lr.ph.i ], [ %"$phi88.1.2.1.7.i.lcssa", %B92.loopexit.unr-lcssa.i ]
  %.1004244.epil.init.i = phi i64 [ 0, %B50.lr.ph.i ], [ %unroll_iter.i, %B92.loopexit.unr-lcssa.i ]
  %sunkaddr120 = getelementptr i8, ptr %arg.r, i64 672
  br label %B50.epil.i

B50.epil.i:
  %lsr.iv.i = phi i64 [ %lsr.iv.next.i, %B88.epil.i ], [ %xtraiter.i, %B50.epil.preheader.i ]
  %low.2.046.epil.i = phi i1 [ %"$phi88.1.2.1.epil.i", %B88.epil.i ], [ %low.2.046.epil.init.i, %B50.epil.preheader.i ]
  %.1004244.epil.i = phi i64 [ %.107.epil.i, %B88.epil.i ], [ %.1004244.epil.init.i, %B50.epil.preheader.i ]
  br i1 %low.2.046.epil.i, label %B88.epil.i, label %B56.epil.i

B56.epil.i:
  %.145.epil.i = load i64, ptr %sunkaddr120, align 8, !noalias !143
  %.146.epil.i = inttoptr i64 %.145.epil.i to ptr
  %8 = shl i64 %.1004244.epil.i, 3
  %scevgep.i = getelementptr i8, ptr %.146.epil.i, i64 %8
  %.149.epil.i = load double, ptr %scevgep.i, align 8, !noalias !143
  %.152.epil.i = fcmp ole double %.149.epil.i, 0.000000e+00
  br label %B88.epil.i

B88.epil.i:
  %"$phi88.1.2.1.epil.i" = phi i1 [ true, %B50.epil.i ], [ %.152.epil.i, %B56.epil.i ]
  %lsr.iv.next.i = add nsw i64 %lsr.iv.i, -1
  %.107.epil.i = add nuw nsw i64 %.1004244.epil.i, 1
  %epil.iter.cmp.not.i = icmp eq i64 %lsr.iv.next.i, 0
  br i1 %epil.iter.cmp.not.i, label %_ZN18biped_adrc_kernels10begins_lowB3v53B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a.exit, label %B50.epil.i, !llvm.loop !146

_ZN18biped_adrc_kernels10begins_lowB3v53B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a.exit:
  %"$phi88.1.2.1.lcssa.i" = phi i1 [ %"$phi88.1.2.1.7.i.lcssa", %B92.loopexit.unr-lcssa.i ], [ %"$phi88.1.2.1.epil.i", %B88.epil.i ]
  br i1 %"$phi88.1.2.1.lcssa.i", label %B92.endif, label %B190

common.ret:
  %common.ret.op = phi i32 [ 0, %B186 ], [ 0, %B740 ], [ 0, %B754 ], [ %.535, %B628.endif.if.if ], [ %.494, %B628.if.if ], [ %.449, %B460.if.if ], [ %.185, %B258.endif.if.if ], [ 0, %B294.endif ], [ %.241, %B294.if.if ]
  ret i32 %common.ret.op

B186:
  store i64 %.136, ptr %retptr, align 8
  br label %common.ret

B190:
  %before.4.0 = phi double [ %.13.i9, %B92.endif ], [ %arg.t0, %B0.endif ], [ %arg.t0, %B62 ], [ %arg.t0, %_ZN18biped_adrc_kernels10begins_lowB3v53B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a.exit ]
  %.163 = getelementptr i8, ptr %arg.r, i64 712
  %.164 = load i64, ptr %.163, align 8
  %.165 = inttoptr i64 %.164 to ptr
  %.167 = getelementptr i8, ptr %arg.r, i64 680
  %.168 = load i64, ptr %.167, align 8
  %.169 = inttoptr i64 %.168 to ptr
  %.172 = tail call ptr @watch(ptr nonnull %arg.r, double %arg.t1, ptr %.165, ptr %.169)
  %.174 = icmp sgt i64 %.13.i, 1
  br i1 %.174, label %B258, label %B362.endif

B258:
  store i8 0, ptr %.181, align 1
  %.185 = call i32 @_ZN18biped_adrc_kernels7suspectB3v54B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2addx(ptr nonnull %.181, ptr nonnull %excinfo.4, ptr nonnull %arg.r, double %arg.t0, double %arg.t1, i64 %.13.i.i)
  %.186 = load ptr, ptr %excinfo.4, align 8
  %.193 = icmp sgt i32 %.185, 0
  %.194 = select i1 %.193, ptr %.186, ptr undef
  %.195 = load i8, ptr %.181, align 1
  %.198 = icmp eq i8 %.195, 0
  %9 = icmp eq i32 %.185, 0
  br i1 %.198, label %B258.endif.thread, label %B258.endif

B294:
  %.226 = load i64, ptr %.167, align 8
  %.227 = inttoptr i64 %.226 to ptr
  %.229 = getelementptr i8, ptr %arg.r, i64 672
  %.230 = load i64, ptr %.229, align 8
  %.231 = inttoptr i64 %.230 to ptr
  %.233 = getelementptr i8, ptr %arg.r, i64 136
  %.234 = load i64, ptr %.233, align 8
  %.241 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.237, ptr nonnull %excinfo.5, ptr %.227, ptr %.231, i64 %.234)
  switch i32 %.241, label %B294.if.if [
    i32 -2, label %B294.endif
    i32 0, label %B294.endif
  ], !prof !8

B400:
  %.35690 = phi i64 [ 1, %B362.endif ], [ %.363, %B628.endif.endif ]
  %before.3.0 = phi double [ %before.4.0, %B362.endif ], [ %"$phi446.1.2.1", %B628.endif.endif ]
  %10 = sub i64 %.35690, %.13.i.i
  %exitcond.not = icmp eq i64 %10, 1
  br i1 %exitcond.not, label %B754, label %B402

B402:
  %.393 = icmp eq i64 %.35690, %.13.i.i
  %.404 = sitofp i64 %.35690 to double
  %.405 = fmul double %.6.i, %.404
  %.411 = fdiv double %.405, %.407
  %.413 = fadd double %arg.t0, %.411
  %"$phi446.1.2.1" = select i1 %.393, double %arg.t1, double %.413
  %.425 = icmp slt i64 %.35690, %.13.i.i
  br i1 %.425, label %B460, label %B560

B460:
  %.9.i = call i32 @_ZN18biped_adrc_kernels6retakeB3v38B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add(ptr nonnull %.5.i, ptr nonnull poison, ptr nonnull %arg.r, double %arg.t0, double %"$phi446.1.2.1") #0
  %.436 = load i64, ptr %sunkaddr122, align 8
  %.437 = inttoptr i64 %.436 to ptr
  %.440 = load i64, ptr %.167, align 8
  %.441 = inttoptr i64 %.440 to ptr
  %.444 = load i64, ptr %sunkaddr124, align 8
  %.449 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.445, ptr nonnull %excinfo.6, ptr %.437, ptr %.441, i64 %.444)
  switch i32 %.449, label %B460.if.if [
    i32 -2, label %B628
    i32 0, label %B628
  ], !prof !8

B560:
  br i1 %.174, label %B572, label %B628

B572:
  %.475 = load i64, ptr %.163, align 8
  %.476 = inttoptr i64 %.475 to ptr
  %.479 = load i64, ptr %.167, align 8
  %.480 = inttoptr i64 %.479 to ptr
  %.483 = tail call ptr @watch(ptr nonnull %arg.r, double %arg.t1, ptr %.476, ptr %.480)
  br label %B628

B628:
  store i64 0, ptr %.490, align 8
  %.494 = call i32 @_ZN18biped_adrc_kernels7crossedB3v48B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2addd(ptr nonnull %.490, ptr nonnull %excinfo.7, ptr nonnull %arg.r, double %arg.t0, double %before.3.0, double %"$phi446.1.2.1")
  %.504 = load i64, ptr %.490, align 8
  %cond13 = icmp eq i32 %.494, 0
  br i1 %cond13, label %B628.endif, label %B628.if.if, !prof !24

B740:
  store i64 %.504, ptr %retptr, align 8
  br label %common.ret

B754:
  store i64 0, ptr %retptr, align 8
  br label %common.ret

B92.endif:
  %.102 = fadd double %arg.t0, 0x3EB0C6F7A0B5ED8D
  %.12.i8 = fcmp olt double %arg.t1, %.102
  %.13.i9 = select i1 %.12.i8, double %arg.t1, double %.102
  %.136 = tail call i64 @lift(ptr nonnull %arg.r, double %arg.t0, double %.13.i9)
  %.141.not = icmp eq i64 %.136, 0
  br i1 %.141.not, label %B190, label %B186

B258.endif:
  br i1 %9, label %B362.endif, label %B258.endif.if.if, !prof !24

B258.endif.thread:
  br i1 %9, label %B294, label %B258.endif.if.if, !prof !24

B258.endif.if.if:
  store ptr %.194, ptr %excinfo, align 8
  br label %common.ret

B294.endif:
  store i64 0, ptr %retptr, align 8
  br label %common.ret

B294.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B362.endif:
  %.407 = uitofp nneg i64 %.13.i.i to double
  %sunkaddr122 = getelementptr i8, ptr %arg.r, i64 688
  %sunkaddr124 = getelementptr i8, ptr %arg.r, i64 136
  %sunkaddr128 = getelementptr i8, ptr %arg.r, i64 672
  br label %B400

B460.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B628.endif:
  %.522 = load i64, ptr %.167, align 8
  %.523 = inttoptr i64 %.522 to ptr
  %.526 = load i64, ptr %sunkaddr128, align 8
  %.527 = inttoptr i64 %.526 to ptr
  %.530 = load i64, ptr %sunkaddr124, align 8
  %.535 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.531, ptr nonnull %excinfo.8, ptr %.523, ptr %.527, i64 %.530)
  switch i32 %.535, label %B628.endif.if.if [
    i32 -2, label %B628.endif.endif
    i32 0, label %B628.endif.endif
  ], !prof !8

B628.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B628.endif.endif:
  %.556.not = icmp eq i64 %.504, 0
  %.363 = add nuw i64 %.35690, 1
  br i1 %.556.not, label %B400, label %B740

B628.endif.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret
}


declare double @llvm.ceil.f64(double) #2


declare i64 @llvm.smax.i64(i64, i64) #2

define linkonce_odr i32 @_ZN18biped_adrc_kernels7suspectB3v54B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2addx(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r, double %arg.t0, double %arg.t1, i64 %arg.count) local_unnamed_addr {
B0.endif:
  %.201 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.17 = getelementptr i8, ptr %arg.r, i64 672
  %.18 = load i64, ptr %.17, align 8
  %.19 = inttoptr i64 %.18 to ptr
  %.21 = load double, ptr %.19, align 8
  %.26 = getelementptr i8, ptr %.19, i64 8
  %.27 = load double, ptr %.26, align 8
  %.32 = getelementptr i8, ptr %.19, i64 16
  %.33 = load double, ptr %.32, align 8
  %.arg.count = tail call i64 @llvm.smax.i64(i64 %arg.count, i64 0)
  %.187 = fsub double %arg.t1, %arg.t0
  %.191 = sitofp i64 %arg.count to double
  %sunkaddr3 = getelementptr i8, ptr %arg.r, i64 680
  %sunkaddr = getelementptr i8, ptr %arg.r, i64 688
  %sunkaddr4 = getelementptr i8, ptr %arg.r, i64 728
  br label %B120

B120:
  %.13266 = phi i64 [ 1, %B0.endif ], [ %.139, %B400 ]
  %v2.2.0 = phi double [ %.33, %B0.endif ], [ %.258, %B400 ]
  %v1.2.0 = phi double [ %.27, %B0.endif ], [ %.255, %B400 ]
  %v0.2.0 = phi double [ %.21, %B0.endif ], [ %.252, %B400 ]
  %0 = sub i64 %.13266, %.arg.count
  %exitcond.not = icmp eq i64 %0, 1
  br i1 %exitcond.not, label %B452, label %B122

B122:
  %.169 = load i64, ptr %sunkaddr3, align 8
  %.170 = inttoptr i64 %.169 to ptr
  %.176 = icmp slt i64 %.13266, %arg.count
  br i1 %.176, label %B150, label %B292

B150:
  %.180 = load i64, ptr %sunkaddr, align 8
  %.190 = sitofp i64 %.13266 to double
  %.195 = fdiv double %.190, %.191
  %.198 = load i64, ptr %sunkaddr4, align 8
  %.199 = inttoptr i64 %.198 to ptr
  %.205 = call i32 @_ZN18biped_adrc_kernels7hermiteB3v55B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add10float64_2a(ptr nonnull %.201, ptr nonnull %excinfo.1, ptr nonnull %arg.r, double %.187, double %.195, ptr %.199)
  switch i32 %.205, label %B150.endif.if.if [
    i32 -2, label %B150.endif.endif
    i32 0, label %B150.endif.endif
  ], !prof !8

B292:
  %w.2.1 = phi ptr [ %.181, %B150.endif.endif ], [ %.170, %B122 ]
  %.252 = load double, ptr %w.2.1, align 8
  %.254 = getelementptr i8, ptr %w.2.1, i64 8
  %.255 = load double, ptr %.254, align 8
  %.257 = getelementptr i8, ptr %w.2.1, i64 16
  %.258 = load double, ptr %.257, align 8
  %.271 = fcmp ogt double %v0.2.0, 0.000000e+00
  %.280 = fcmp ole double %.252, 0.000000e+00
  %or.cond = select i1 %.271, i1 %.280, i1 false
  br i1 %or.cond, label %B432, label %B370

B370:
  %.289 = fcmp ogt double %v1.2.0, 0.000000e+00
  %.298 = fcmp ole double %.255, 0.000000e+00
  %or.cond62 = select i1 %.289, i1 %.298, i1 false
  br i1 %or.cond62, label %B432, label %B400

B400:
  %.307 = fcmp ogt double %v2.2.0, 0.000000e+00
  %.316 = fcmp ole double %.258, 0.000000e+00
  %or.cond63 = select i1 %.307, i1 %.316, i1 false
  %.139 = add nuw i64 %.13266, 1
  br i1 %or.cond63, label %B432, label %B120

common.ret:
  %common.ret.op = phi i32 [ 0, %B432 ], [ 0, %B452 ], [ %.205, %B150.endif.if.if ]
  ret i32 %common.ret.op

B432:
  store i8 1, ptr %retptr, align 1
  br label %common.ret

B452:
  store i8 0, ptr %retptr, align 1
  br label %common.ret

B150.endif.endif:
  %.181 = inttoptr i64 %.180 to ptr
  %.230 = fmul double %.187, %.190
  %.238 = fdiv double %.230, %.191
  %.240 = fadd double %arg.t0, %.238
  %.243 = load i64, ptr %sunkaddr4, align 8
  %.244 = inttoptr i64 %.243 to ptr
  %.246 = tail call ptr @watch(ptr nonnull %arg.r, double %.240, ptr %.244, ptr %.181)
  br label %B292

B150.endif.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels7hermiteB3v55B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add10float64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.r, double %arg.h, double %arg.s, ptr writeonly %arg.out) local_unnamed_addr #0 {
B0.endif:
  %.17 = getelementptr i8, ptr %arg.r, i64 72
  %.18 = load i64, ptr %.17, align 8
  %.10040.not = icmp slt i64 %.18, 1
  br i1 %.10040.not, label %B300, label %B46.lr.ph

B46.lr.ph:
  %.152 = fsub double 1.000000e+00, %arg.s
  %.195 = fmul double %arg.s, %.152
  %xtraiter = and i64 %.18, 3
  %0 = icmp samesign ult i64 %.18, 4
  br i1 %0, label %B46.epil.preheader, label %B46.lr.ph.new

B46.lr.ph.new:
  %1 = and i64 %.18, 9223372036854775804
  %sunkaddr = getelementptr i8, ptr %arg.r, i64 712
  %sunkaddr38 = getelementptr i8, ptr %arg.r, i64 696
  br label %B46

B46:
  %lsr.iv7 = phi i64 [ %lsr.iv.next8, %B46 ], [ 3, %B46.lr.ph.new ]
  %.140 = load i64, ptr %sunkaddr, align 8
  %.141 = inttoptr i64 %.140 to ptr
  %2 = shl i64 %lsr.iv7, 3
  %scevgep36 = getelementptr i8, ptr %.141, i64 %2
  %scevgep37 = getelementptr i8, ptr %scevgep36, i64 -24
  %.143 = load double, ptr %scevgep37, align 8
  %.146 = load i64, ptr %sunkaddr38, align 8
  %.147 = inttoptr i64 %.146 to ptr
  %scevgep34 = getelementptr i8, ptr %.147, i64 %2
  %scevgep35 = getelementptr i8, ptr %scevgep34, i64 -24
  %.149 = load double, ptr %scevgep35, align 8
  %.150 = fsub double %.143, %.149
  %.159 = load i64, ptr %.17, align 8
  %3 = add nsw i64 %lsr.iv7, -3
  %4 = add i64 %3, %.159
  %.161 = getelementptr double, ptr %.147, i64 %4
  %.162 = load double, ptr %.161, align 8
  %.164 = fmul double %arg.h, %.162
  %.165 = fsub double %.164, %.150
  %.166 = fmul double %.152, %.165
  %.175 = getelementptr double, ptr %.141, i64 %4
  %.176 = load double, ptr %.175, align 8
  %.178 = fmul double %arg.h, %.176
  %.179 = fsub double %.178, %.150
  %.181 = fmul double %arg.s, %.179
  %.182 = fsub double %.166, %.181
  %.190 = fmul double %arg.s, %.150
  %.191 = fadd double %.149, %.190
  %.196 = fmul double %.195, %.182
  %.197 = fadd double %.191, %.196
  %scevgep26 = getelementptr i8, ptr %arg.out, i64 %2
  %scevgep33 = getelementptr i8, ptr %scevgep26, i64 -24
  store double %.197, ptr %scevgep33, align 8
  %.140.1 = load i64, ptr %sunkaddr, align 8
  %.141.1 = inttoptr i64 %.140.1 to ptr
  %scevgep19 = getelementptr i8, ptr %.141.1, i64 %2
  %scevgep20 = getelementptr i8, ptr %scevgep19, i64 -16
  %.143.1 = load double, ptr %scevgep20, align 8
  %.146.1 = load i64, ptr %sunkaddr38, align 8
  %.147.1 = inttoptr i64 %.146.1 to ptr
  %scevgep17 = getelementptr i8, ptr %.147.1, i64 %2
  %scevgep18 = getelementptr i8, ptr %scevgep17, i64 -16
  %.149.1 = load double, ptr %scevgep18, align 8
  %.150.1 = fsub double %.143.1, %.149.1
  %.159.1 = load i64, ptr %.17, align 8
  %5 = add nsw i64 %lsr.iv7, -2
  %6 = add i64 %5, %.159.1
  %.161.1 = getelementptr double, ptr %.147.1, i64 %6
  %.162.1 = load double, ptr %.161.1, align 8
  %.164.1 = fmul double %arg.h, %.162.1
  %.165.1 = fsub double %.164.1, %.150.1
  %.166.1 = fmul double %.152, %.165.1
  %.175.1 = getelementptr double, ptr %.141.1, i64 %6
  %.176.1 = load double, ptr %.175.1, align 8
  %.178.1 = fmul double %arg.h, %.176.1
  %.179.1 = fsub double %.178.1, %.150.1
  %.181.1 = fmul double %arg.s, %.179.1
  %.182.1 = fsub double %.166.1, %.181.1
  %.190.1 = fmul double %arg.s, %.150.1
  %.191.1 = fadd double %.149.1, %.190.1
  %.196.1 = fmul double %.195, %.182.1
  %.197.1 = fadd double %.191.1, %.196.1
  %scevgep25 = getelementptr i8, ptr %scevgep26, i64 -16
  store double %.197.1, ptr %scevgep25, align 8
  %.140.2 = load i64, ptr %sunkaddr, align 8
  %.141.2 = inttoptr i64 %.140.2 to ptr
  %scevgep15 = getelementptr i8, ptr %.141.2, i64 %2
  %scevgep16 = getelementptr i8, ptr %scevgep15, i64 -8
  %.143.2 = load double, ptr %scevgep16, align 8
  %.146.2 = load i64, ptr %sunkaddr38, align 8
  %.147.2 = inttoptr i64 %.146.2 to ptr
  %scevgep13 = getelementptr i8, ptr %.147.2, i64 %2
  %scevgep14 = getelementptr i8, ptr %scevgep13, i64 -8
  %.149.2 = load double, ptr %scevgep14, align 8
  %.150.2 = fsub double %.143.2, %.149.2
  %.159.2 = load i64, ptr %.17, align 8
  %7 = add nsw i64 %lsr.iv7, -1
  %8 = add i64 %7, %.159.2
  %.161.2 = getelementptr double, ptr %.147.2, i64 %8
  %.162.2 = load double, ptr %.161.2, align 8
  %.164.2 = fmul double %arg.h, %.162.2
  %.165.2 = fsub double %.164.2, %.150.2
  %.166.2 = fmul double %.152, %.165.2
  %.175.2 = getelementptr double, ptr %.141.2, i64 %8
  %.176.2 = load double, ptr %.175.2, align 8
  %.178.2 = fmul double %arg.h, %.176.2
  %.179.2 = fsub double %.178.2, %.150.2
  %.181.2 = fmul double %arg.s, %.179.2
  %.182.2 = fsub double %.166.2, %.181.2
  %.190.2 = fmul double %arg.s, %.150.2
  %.191.2 = fadd double %.149.2, %.190.2
  %.196.2 = fmul double %.195, %.182.2
  %.197.2 = fadd double %.191.2, %.196.2
  %scevgep23 = getelementptr i8, ptr %scevgep26, i64 -8
  store double %.197.2, ptr %scevgep23, align 8
  %.140.3 = load i64, ptr %sunkaddr, align 8
  %.141.3 = inttoptr i64 %.140.3 to ptr
  %scevgep12 = getelementptr i8, ptr %.141.3, i64 %2
  %.143.3 = load double, ptr %scevgep12, align 8
  %.146.3 = load i64, ptr %sunkaddr38, align 8
  %.147.3 = inttoptr i64 %.146.3 to ptr
  %scevgep10 = getelementptr i8, ptr %.147.3, i64 %2
  %.149.3 = load double, ptr %scevgep10, align 8
  %.150.3 = fsub double %.143.3, %.149.3
  %.159.3 = load i64, ptr %.17, align 8
  %9 = add i64 %.159.3, %lsr.iv7
  %.161.3 = getelementptr double, ptr %.147.3, i64 %9
  %.162.3 = load double, ptr %.161.3, align 8
  %.164.3 = fmul double %arg.h, %.162.3
  %.165.3 = fsub double %.164.3, %.150.3
  %.166.3 = fmul double %.152, %.165.3
  %.175.3 = getelementptr double, ptr %.141.3, i64 %9
  %.176.3 = load double, ptr %.175.3, align 8
  %.178.3 = fmul double %arg.h, %.176.3
  %.179.3 = fsub double %.178.3, %.150.3
  %.181.3 = fmul double %arg.s, %.179.3
  %.182.3 = fsub double %.166.3, %.181.3
  %.190.3 = fmul double %arg.s, %.150.3
  %.191.3 = fadd double %.149.3, %.190.3
  %.196.3 = fmul double %.195, %.182.3
  %.197.3 = fadd double %.191.3, %.196.3
  store double %.197.3, ptr %scevgep26, align 8
  %lsr.iv.next8 = add nuw nsw i64 %lsr.iv7, 4
  %10 = sub nsw i64 %lsr.iv.next8, %1
  %niter.ncmp.3 = icmp eq i64 %10, 3
  br i1 %niter.ncmp.3, label %B300.loopexit.unr-lcssa, label %B46

B300.loopexit.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B300, label %B46.epil.preheader

B46.epil.preheader:
  %.1063941.epil.init = phi i64 [ 0, %B46.lr.ph ], [ %1, %B300.loopexit.unr-lcssa ]
  %sunkaddr40 = getelementptr i8, ptr %arg.r, i64 712
  %sunkaddr41 = getelementptr i8, ptr %arg.r, i64 696
  br label %B46.epil

B46.epil:
  %lsr.iv = phi i64 [ %lsr.iv.next, %B46.epil ], [ %xtraiter, %B46.epil.preheader ]
  %.1063941.epil = phi i64 [ %.113.epil, %B46.epil ], [ %.1063941.epil.init, %B46.epil.preheader ]
  %.113.epil = add nuw nsw i64 %.1063941.epil, 1
  %.140.epil = load i64, ptr %sunkaddr40, align 8
  %.141.epil = inttoptr i64 %.140.epil to ptr
  %11 = shl i64 %.1063941.epil, 3
  %scevgep3 = getelementptr i8, ptr %.141.epil, i64 %11
  %.143.epil = load double, ptr %scevgep3, align 8
  %.146.epil = load i64, ptr %sunkaddr41, align 8
  %.147.epil = inttoptr i64 %.146.epil to ptr
  %scevgep2 = getelementptr i8, ptr %.147.epil, i64 %11
  %.149.epil = load double, ptr %scevgep2, align 8
  %.150.epil = fsub double %.143.epil, %.149.epil
  %.159.epil = load i64, ptr %.17, align 8
  %12 = add i64 %.159.epil, %.1063941.epil
  %.161.epil = getelementptr double, ptr %.147.epil, i64 %12
  %.162.epil = load double, ptr %.161.epil, align 8
  %.164.epil = fmul double %arg.h, %.162.epil
  %.165.epil = fsub double %.164.epil, %.150.epil
  %.166.epil = fmul double %.152, %.165.epil
  %.175.epil = getelementptr double, ptr %.141.epil, i64 %12
  %.176.epil = load double, ptr %.175.epil, align 8
  %.178.epil = fmul double %arg.h, %.176.epil
  %.179.epil = fsub double %.178.epil, %.150.epil
  %.181.epil = fmul double %arg.s, %.179.epil
  %.182.epil = fsub double %.166.epil, %.181.epil
  %.190.epil = fmul double %arg.s, %.150.epil
  %.191.epil = fadd double %.149.epil, %.190.epil
  %.196.epil = fmul double %.195, %.182.epil
  %.197.epil = fadd double %.191.epil, %.196.epil
  %scevgep6 = getelementptr i8, ptr %arg.out, i64 %11
  store double %.197.epil, ptr %scevgep6, align 8
  %lsr.iv.next = add nsw i64 %lsr.iv, -1
  %epil.iter.cmp.not = icmp eq i64 %lsr.iv.next, 0
  br i1 %epil.iter.cmp.not, label %B300, label %B46.epil, !llvm.loop !147

B300:
  store ptr null, ptr %retptr, align 8
  ret i32 0
}


define i64 @event(ptr %.1, double %.2, double %.3) local_unnamed_addr #0 {
entry:
  %.5 = alloca i64, align 8
  store i64 0, ptr %.5, align 8
  %excinfo = alloca ptr, align 8
  %.9 = call i32 @_ZN18biped_adrc_kernels5eventB3v50B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add(ptr nonnull %.5, ptr nonnull %excinfo, ptr %.1, double %.2, double %.3) #0
  %cond = icmp eq i32 %.9, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.19 = load i64, ptr %.5, align 8
  ret i64 %.19
}

define i32 @_ZN18biped_adrc_kernels5fixedB3v56B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2addx(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r, double %arg.t, double %arg.t1, i64 %arg.last) local_unnamed_addr {
B0:
  %.224 = alloca i8, align 1
  %excinfo.4 = alloca ptr, align 8
  %.17 = getelementptr i8, ptr %arg.r, i64 712
  %.18 = load i64, ptr %.17, align 8
  %.24 = getelementptr i8, ptr %arg.r, i64 144
  %.25 = load i64, ptr %.24, align 8
  %.26 = icmp eq i64 %.25, 0
  br i1 %.26, label %B454.sink.split, label %B118

B118:
  %.48 = fsub double %arg.t1, %arg.t
  %.50 = getelementptr i8, ptr %arg.r, i64 248
  %.52 = load double, ptr %.50, align 8
  %.53 = fsub double %.48, %.52
  %.54 = tail call double @llvm.fabs.f64(double %.53)
  %.59 = fmul double %.52, 1.000000e-09
  %.60 = fcmp ugt double %.54, %.59
  br i1 %.60, label %B328, label %B204

B204:
  %0 = inttoptr i64 %.18 to ptr
  %.66 = getelementptr i8, ptr %arg.r, i64 800
  %.67 = load i64, ptr %.66, align 8
  %.68 = inttoptr i64 %.67 to ptr
  %.70 = getelementptr i8, ptr %arg.r, i64 856
  %.71 = load i64, ptr %.70, align 8
  %.72 = inttoptr i64 %.71 to ptr
  %.74 = getelementptr i8, ptr %arg.r, i64 808
  %.75 = load i64, ptr %.74, align 8
  %.76 = inttoptr i64 %.75 to ptr
  %.79 = tail call ptr @exponential(ptr nonnull %arg.r, i64 0, double %arg.t, double %.48, ptr %.68, ptr %.72, ptr %.76)
  %.85 = load i64, ptr %.74, align 8
  %.86 = inttoptr i64 %.85 to ptr
  %.7.i = getelementptr i8, ptr %arg.r, i64 40
  %.8.i = load i64, ptr %.7.i, align 8, !noalias !148
  %.9.i = getelementptr i8, ptr %arg.r, i64 272
  %.10.i = load i64, ptr %.9.i, align 8, !noalias !148
  %.11.i = inttoptr i64 %.10.i to ptr
  %.12.i = inttoptr i64 %.8.i to ptr
  tail call void %.12.i(ptr %.11.i, ptr %.86, ptr %0), !noalias !148
  br label %B454

B328:
  %.120 = tail call ptr @halve(ptr nonnull %arg.r, i64 -1, double %arg.t, double %arg.t1, double %arg.t1, double 0.000000e+00)
  %.124 = getelementptr i8, ptr %arg.r, i64 528
  %.126 = load double, ptr %.124, align 8
  br label %B454.sink.split

B454.sink.split:
  %.sink29 = phi i64 [ 784, %B328 ], [ 696, %B0 ]
  %.sink = phi i64 [ 792, %B328 ], [ 704, %B0 ]
  %.126.sink28 = phi double [ %.126, %B328 ], [ %arg.t, %B0 ]
  %1 = inttoptr i64 %.18 to ptr
  %.128 = getelementptr i8, ptr %arg.r, i64 %.sink29
  %.129 = load i64, ptr %.128, align 8
  %.130 = inttoptr i64 %.129 to ptr
  %.132 = getelementptr i8, ptr %arg.r, i64 %.sink
  %.133 = load i64, ptr %.132, align 8
  %.134 = inttoptr i64 %.133 to ptr
  %.140 = fsub double %arg.t1, %.126.sink28
  %.143 = tail call ptr @classical(ptr nonnull %arg.r, double %.126.sink28, ptr %.130, ptr %.134, double %.140, ptr %1)
  br label %B454

B454:
  %.147 = getelementptr i8, ptr %arg.r, i64 96
  %.148 = load i64, ptr %.147, align 8
  %.9240.not.i = icmp slt i64 %.148, 1
  br i1 %.9240.not.i, label %B526, label %iter.check.i

iter.check.i:
  %min.iters.check.i = icmp samesign ult i64 %.148, 4
  br i1 %min.iters.check.i, label %iter.check.i.B40.i.preheader_crit_edge, label %vector.main.loop.iter.check.i

iter.check.i.B40.i.preheader_crit_edge:
  %.pre35 = inttoptr i64 %.18 to ptr
  br label %B40.i.preheader

vector.main.loop.iter.check.i:
  %min.iters.check1.i = icmp samesign ult i64 %.148, 16
  br i1 %min.iters.check1.i, label %vector.main.loop.iter.check.i.vec.epilog.ph.i_crit_edge, label %vector.ph.i

vector.main.loop.iter.check.i.vec.epilog.ph.i_crit_edge:
  %.pre37 = inttoptr i64 %.18 to ptr
  br label %vec.epilog.ph.i

vector.ph.i:
  %n.vec.i = and i64 %.148, 9223372036854775792
  %sunkaddr = inttoptr i64 %.18 to ptr
  br label %vector.body.i

vector.body.i:
  %index.i = phi i64 [ 0, %vector.ph.i ], [ %index.next.i, %vector.body.i ]
  %vec.phi.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %10, %vector.body.i ]
  %vec.phi2.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %11, %vector.body.i ]
  %vec.phi3.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %12, %vector.body.i ]
  %vec.phi4.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %13, %vector.body.i ]
  %sunkaddr243 = shl i64 %index.i, 3
  %sunkaddr244 = getelementptr i8, ptr %sunkaddr, i64 %sunkaddr243
  %wide.load.i = load <4 x double>, ptr %sunkaddr244, align 8, !noalias !151
  %sunkaddr248 = getelementptr i8, ptr %sunkaddr244, i64 32
  %wide.load5.i = load <4 x double>, ptr %sunkaddr248, align 8, !noalias !151
  %sunkaddr252 = getelementptr i8, ptr %sunkaddr244, i64 64
  %wide.load6.i = load <4 x double>, ptr %sunkaddr252, align 8, !noalias !151
  %sunkaddr256 = getelementptr i8, ptr %sunkaddr244, i64 96
  %wide.load7.i = load <4 x double>, ptr %sunkaddr256, align 8, !noalias !151
  %2 = tail call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load.i)
  %3 = fcmp one <4 x double> %2, splat (double 0x7FF0000000000000)
  %4 = tail call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load5.i)
  %5 = fcmp one <4 x double> %4, splat (double 0x7FF0000000000000)
  %6 = tail call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load6.i)
  %7 = fcmp one <4 x double> %6, splat (double 0x7FF0000000000000)
  %8 = tail call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load7.i)
  %9 = fcmp one <4 x double> %8, splat (double 0x7FF0000000000000)
  %10 = and <4 x i1> %vec.phi.i, %3
  %11 = and <4 x i1> %vec.phi2.i, %5
  %12 = and <4 x i1> %vec.phi3.i, %7
  %13 = and <4 x i1> %vec.phi4.i, %9
  %index.next.i = add nuw nsw i64 %index.i, 16
  %14 = icmp eq i64 %n.vec.i, %index.next.i
  br i1 %14, label %middle.block.i, label %vector.body.i, !llvm.loop !154

middle.block.i:
  %bin.rdx.i = and <4 x i1> %10, %11
  %bin.rdx8.i = and <4 x i1> %12, %bin.rdx.i
  %bin.rdx9.i = and <4 x i1> %13, %bin.rdx8.i
  %15 = bitcast <4 x i1> %bin.rdx9.i to i4
  %16 = icmp eq i4 %15, -1
  %cmp.n.i = icmp eq i64 %.148, %n.vec.i
  br i1 %cmp.n.i, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit, label %vec.epilog.iter.check.i

vec.epilog.iter.check.i:
  %17 = and i64 %.148, 12
  %min.epilog.iters.check.i = icmp eq i64 %17, 0
  br i1 %min.epilog.iters.check.i, label %B40.i.preheader, label %vec.epilog.ph.i, !prof !20

vec.epilog.ph.i:
  %.pre-phi38 = phi ptr [ %.pre37, %vector.main.loop.iter.check.i.vec.epilog.ph.i_crit_edge ], [ %sunkaddr, %vec.epilog.iter.check.i ]
  %vec.epilog.resume.val.i = phi i64 [ 0, %vector.main.loop.iter.check.i.vec.epilog.ph.i_crit_edge ], [ %n.vec.i, %vec.epilog.iter.check.i ]
  %bc.merge.rdx.i = phi i1 [ true, %vector.main.loop.iter.check.i.vec.epilog.ph.i_crit_edge ], [ %16, %vec.epilog.iter.check.i ]
  %n.vec11.i = and i64 %.148, 9223372036854775804
  %18 = insertelement <4 x i1> <i1 poison, i1 true, i1 true, i1 true>, i1 %bc.merge.rdx.i, i64 0
  br label %vec.epilog.vector.body.i

vec.epilog.vector.body.i:
  %index12.i = phi i64 [ %vec.epilog.resume.val.i, %vec.epilog.ph.i ], [ %index.next15.i, %vec.epilog.vector.body.i ]
  %vec.phi13.i = phi <4 x i1> [ %18, %vec.epilog.ph.i ], [ %22, %vec.epilog.vector.body.i ]
  %19 = shl i64 %index12.i, 3
  %scevgep28.i = getelementptr i8, ptr %.pre-phi38, i64 %19
  %wide.load14.i = load <4 x double>, ptr %scevgep28.i, align 8, !noalias !151
  %20 = tail call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load14.i)
  %21 = fcmp one <4 x double> %20, splat (double 0x7FF0000000000000)
  %22 = and <4 x i1> %vec.phi13.i, %21
  %index.next15.i = add nuw i64 %index12.i, 4
  %23 = icmp eq i64 %n.vec11.i, %index.next15.i
  br i1 %23, label %vec.epilog.middle.block.i, label %vec.epilog.vector.body.i, !llvm.loop !155

vec.epilog.middle.block.i:
  %24 = bitcast <4 x i1> %22 to i4
  %25 = icmp eq i4 %24, -1
  %cmp.n16.i = icmp eq i64 %.148, %n.vec11.i
  br i1 %cmp.n16.i, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit, label %B40.i.preheader

B40.i.preheader:
  %.pre-phi36 = phi ptr [ %.pre35, %iter.check.i.B40.i.preheader_crit_edge ], [ %.pre-phi38, %vec.epilog.middle.block.i ], [ %sunkaddr, %vec.epilog.iter.check.i ]
  %good.2.043.i.ph = phi i1 [ true, %iter.check.i.B40.i.preheader_crit_edge ], [ %25, %vec.epilog.middle.block.i ], [ %16, %vec.epilog.iter.check.i ]
  %.983941.i.ph = phi i64 [ 0, %iter.check.i.B40.i.preheader_crit_edge ], [ %n.vec11.i, %vec.epilog.middle.block.i ], [ %n.vec.i, %vec.epilog.iter.check.i ]
  br label %B40.i

B40.i:
  %good.2.043.i = phi i1 [ %.136.i, %B40.i ], [ %good.2.043.i.ph, %B40.i.preheader ]
  %.983941.i = phi i64 [ %.105.i, %B40.i ], [ %.983941.i.ph, %B40.i.preheader ]
  %.105.i = add nuw nsw i64 %.983941.i, 1
  %26 = shl i64 %.983941.i, 3
  %scevgep.i = getelementptr i8, ptr %.pre-phi36, i64 %26
  %.132.i = load double, ptr %scevgep.i, align 8, !noalias !151
  %27 = tail call double @llvm.fabs.f64(double %.132.i)
  %28 = fcmp one double %27, 0x7FF0000000000000
  %.136.i = and i1 %good.2.043.i, %28
  %exitcond.not.i = icmp eq i64 %.148, %.105.i
  br i1 %exitcond.not.i, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit, label %B40.i, !llvm.loop !156

_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit:
  %.136.lcssa.i = phi i1 [ %25, %vec.epilog.middle.block.i ], [ %16, %middle.block.i ], [ %.136.i, %B40.i ]
  br i1 %.136.lcssa.i, label %B526, label %B496.endif

B526:
  %29 = inttoptr i64 %.18 to ptr
  store i8 0, ptr %.224, align 1
  %.228 = call i32 @_ZN18biped_adrc_kernels4slowB3v57B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a(ptr nonnull %.224, ptr nonnull %excinfo.4, ptr nonnull %arg.r, double %arg.t1, ptr %29)
  %.238 = load i8, ptr %.224, align 1
  %.241 = icmp eq i8 %.238, 0
  br i1 %.241, label %B526.endif.thread, label %B526.endif

common.ret:
  %common.ret.op = phi i32 [ 0, %B560 ], [ 0, %B950 ], [ %.228, %B526.endif.if.if ], [ 0, %B920.endif ], [ 0, %B496.endif ], [ 0, %B726.endif ]
  ret i32 %common.ret.op

B560:
  store i64 8, ptr %retptr, align 8
  br label %common.ret

B574:
  %.270 = load i64, ptr %.24, align 8
  %.271 = icmp eq i64 %.270, 1
  %.274 = icmp eq i64 %arg.last, 0
  %or.cond = select i1 %.271, i1 %.274, i1 false
  br i1 %or.cond, label %B618, label %B756

B618:
  %.277 = getelementptr i8, ptr %arg.r, i64 808
  %.278 = load i64, ptr %.277, align 8
  %.279 = inttoptr i64 %.278 to ptr
  %.281 = getelementptr i8, ptr %arg.r, i64 864
  %.282 = load i64, ptr %.281, align 8
  %.283 = inttoptr i64 %.282 to ptr
  %.286 = tail call ptr @remainder(ptr nonnull %arg.r, double %arg.t1, ptr %.279, ptr %.283)
  %.290 = load i64, ptr %.281, align 8
  %.293 = getelementptr i8, ptr %arg.r, i64 120
  %.294 = load i64, ptr %.293, align 8
  %.9240.not.i4 = icmp slt i64 %.294, 1
  br i1 %.9240.not.i4, label %B756, label %iter.check.i5

iter.check.i5:
  %min.iters.check.i6 = icmp samesign ult i64 %.294, 4
  br i1 %min.iters.check.i6, label %iter.check.i5.B40.i49.preheader_crit_edge, label %vector.main.loop.iter.check.i7

iter.check.i5.B40.i49.preheader_crit_edge:
  %.pre31 = inttoptr i64 %.290 to ptr
  br label %B40.i49.preheader

vector.main.loop.iter.check.i7:
  %min.iters.check1.i8 = icmp samesign ult i64 %.294, 16
  br i1 %min.iters.check1.i8, label %vector.main.loop.iter.check.i7.vec.epilog.ph.i34_crit_edge, label %vector.ph.i9

vector.main.loop.iter.check.i7.vec.epilog.ph.i34_crit_edge:
  %.pre33 = inttoptr i64 %.290 to ptr
  br label %vec.epilog.ph.i34

vector.ph.i9:
  %n.vec.i10 = and i64 %.294, 9223372036854775792
  %sunkaddr258 = inttoptr i64 %.290 to ptr
  br label %vector.body.i11

vector.body.i11:
  %index.i12 = phi i64 [ 0, %vector.ph.i9 ], [ %index.next.i26, %vector.body.i11 ]
  %vec.phi.i13 = phi <4 x i1> [ splat (i1 true), %vector.ph.i9 ], [ %38, %vector.body.i11 ]
  %vec.phi2.i14 = phi <4 x i1> [ splat (i1 true), %vector.ph.i9 ], [ %39, %vector.body.i11 ]
  %vec.phi3.i15 = phi <4 x i1> [ splat (i1 true), %vector.ph.i9 ], [ %40, %vector.body.i11 ]
  %vec.phi4.i16 = phi <4 x i1> [ splat (i1 true), %vector.ph.i9 ], [ %41, %vector.body.i11 ]
  %sunkaddr259 = shl i64 %index.i12, 3
  %sunkaddr260 = getelementptr i8, ptr %sunkaddr258, i64 %sunkaddr259
  %wide.load.i19 = load <4 x double>, ptr %sunkaddr260, align 8, !noalias !157
  %sunkaddr264 = getelementptr i8, ptr %sunkaddr260, i64 32
  %wide.load5.i21 = load <4 x double>, ptr %sunkaddr264, align 8, !noalias !157
  %sunkaddr268 = getelementptr i8, ptr %sunkaddr260, i64 64
  %wide.load6.i23 = load <4 x double>, ptr %sunkaddr268, align 8, !noalias !157
  %sunkaddr272 = getelementptr i8, ptr %sunkaddr260, i64 96
  %wide.load7.i25 = load <4 x double>, ptr %sunkaddr272, align 8, !noalias !157
  %30 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load.i19)
  %31 = fcmp one <4 x double> %30, splat (double 0x7FF0000000000000)
  %32 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load5.i21)
  %33 = fcmp one <4 x double> %32, splat (double 0x7FF0000000000000)
  %34 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load6.i23)
  %35 = fcmp one <4 x double> %34, splat (double 0x7FF0000000000000)
  %36 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load7.i25)
  %37 = fcmp one <4 x double> %36, splat (double 0x7FF0000000000000)
  %38 = and <4 x i1> %vec.phi.i13, %31
  %39 = and <4 x i1> %vec.phi2.i14, %33
  %40 = and <4 x i1> %vec.phi3.i15, %35
  %41 = and <4 x i1> %vec.phi4.i16, %37
  %index.next.i26 = add nuw nsw i64 %index.i12, 16
  %42 = icmp eq i64 %n.vec.i10, %index.next.i26
  br i1 %42, label %middle.block.i27, label %vector.body.i11, !llvm.loop !154

middle.block.i27:
  %bin.rdx.i28 = and <4 x i1> %38, %39
  %bin.rdx8.i29 = and <4 x i1> %40, %bin.rdx.i28
  %bin.rdx9.i30 = and <4 x i1> %41, %bin.rdx8.i29
  %43 = bitcast <4 x i1> %bin.rdx9.i30 to i4
  %44 = icmp eq i4 %43, -1
  %cmp.n.i31 = icmp eq i64 %.294, %n.vec.i10
  br i1 %cmp.n.i31, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit60, label %vec.epilog.iter.check.i32

vec.epilog.iter.check.i32:
  %45 = and i64 %.294, 12
  %min.epilog.iters.check.i33 = icmp eq i64 %45, 0
  br i1 %min.epilog.iters.check.i33, label %B40.i49.preheader, label %vec.epilog.ph.i34, !prof !20

vec.epilog.ph.i34:
  %.pre-phi34 = phi ptr [ %.pre33, %vector.main.loop.iter.check.i7.vec.epilog.ph.i34_crit_edge ], [ %sunkaddr258, %vec.epilog.iter.check.i32 ]
  %vec.epilog.resume.val.i35 = phi i64 [ 0, %vector.main.loop.iter.check.i7.vec.epilog.ph.i34_crit_edge ], [ %n.vec.i10, %vec.epilog.iter.check.i32 ]
  %bc.merge.rdx.i36 = phi i1 [ true, %vector.main.loop.iter.check.i7.vec.epilog.ph.i34_crit_edge ], [ %44, %vec.epilog.iter.check.i32 ]
  %n.vec11.i37 = and i64 %.294, 9223372036854775804
  %46 = insertelement <4 x i1> <i1 poison, i1 true, i1 true, i1 true>, i1 %bc.merge.rdx.i36, i64 0
  br label %vec.epilog.vector.body.i38

vec.epilog.vector.body.i38:
  %index12.i39 = phi i64 [ %vec.epilog.resume.val.i35, %vec.epilog.ph.i34 ], [ %index.next15.i43, %vec.epilog.vector.body.i38 ]
  %vec.phi13.i40 = phi <4 x i1> [ %46, %vec.epilog.ph.i34 ], [ %50, %vec.epilog.vector.body.i38 ]
  %47 = shl i64 %index12.i39, 3
  %scevgep28.i41 = getelementptr i8, ptr %.pre-phi34, i64 %47
  %wide.load14.i42 = load <4 x double>, ptr %scevgep28.i41, align 8, !noalias !157
  %48 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load14.i42)
  %49 = fcmp one <4 x double> %48, splat (double 0x7FF0000000000000)
  %50 = and <4 x i1> %vec.phi13.i40, %49
  %index.next15.i43 = add nuw i64 %index12.i39, 4
  %51 = icmp eq i64 %n.vec11.i37, %index.next15.i43
  br i1 %51, label %vec.epilog.middle.block.i44, label %vec.epilog.vector.body.i38, !llvm.loop !155

vec.epilog.middle.block.i44:
  %52 = bitcast <4 x i1> %50 to i4
  %53 = icmp eq i4 %52, -1
  %cmp.n16.i45 = icmp eq i64 %.294, %n.vec11.i37
  br i1 %cmp.n16.i45, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit60, label %B40.i49.preheader

B40.i49.preheader:
  %.pre-phi32 = phi ptr [ %.pre31, %iter.check.i5.B40.i49.preheader_crit_edge ], [ %.pre-phi34, %vec.epilog.middle.block.i44 ], [ %sunkaddr258, %vec.epilog.iter.check.i32 ]
  %good.2.043.i50.ph = phi i1 [ true, %iter.check.i5.B40.i49.preheader_crit_edge ], [ %53, %vec.epilog.middle.block.i44 ], [ %44, %vec.epilog.iter.check.i32 ]
  %.983941.i51.ph = phi i64 [ 0, %iter.check.i5.B40.i49.preheader_crit_edge ], [ %n.vec11.i37, %vec.epilog.middle.block.i44 ], [ %n.vec.i10, %vec.epilog.iter.check.i32 ]
  br label %B40.i49

B40.i49:
  %good.2.043.i50 = phi i1 [ %.136.i55, %B40.i49 ], [ %good.2.043.i50.ph, %B40.i49.preheader ]
  %.983941.i51 = phi i64 [ %.105.i52, %B40.i49 ], [ %.983941.i51.ph, %B40.i49.preheader ]
  %.105.i52 = add nuw nsw i64 %.983941.i51, 1
  %54 = shl i64 %.983941.i51, 3
  %scevgep.i53 = getelementptr i8, ptr %.pre-phi32, i64 %54
  %.132.i54 = load double, ptr %scevgep.i53, align 8, !noalias !157
  %55 = call double @llvm.fabs.f64(double %.132.i54)
  %56 = fcmp one double %55, 0x7FF0000000000000
  %.136.i55 = and i1 %good.2.043.i50, %56
  %exitcond.not.i56 = icmp eq i64 %.294, %.105.i52
  br i1 %exitcond.not.i56, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit60, label %B40.i49, !llvm.loop !156

_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit60:
  %.136.lcssa.i58 = phi i1 [ %53, %vec.epilog.middle.block.i44 ], [ %44, %middle.block.i27 ], [ %.136.i55, %B40.i49 ]
  br i1 %.136.lcssa.i58, label %B756, label %B726.endif

B756:
  %.366 = getelementptr i8, ptr %arg.r, i64 400
  %.367 = load i64, ptr %.366, align 8
  %.368 = icmp sgt i64 %.367, 0
  br i1 %.368, label %B822, label %B778

B778:
  %.372 = load i64, ptr %.24, align 8
  %.373 = icmp eq i64 %.372, 0
  %or.cond27 = select i1 %.373, i1 %.274, i1 false
  br i1 %or.cond27, label %B822, label %B950

B822:
  %.383 = getelementptr i8, ptr %arg.r, i64 720
  %.384 = load i64, ptr %.383, align 8
  %.385 = inttoptr i64 %.384 to ptr
  %.389 = tail call ptr @flow(ptr nonnull %arg.r, double %arg.t1, ptr %29, ptr %.385)
  %.397 = load i64, ptr %.383, align 8
  %.401 = load i64, ptr %.147, align 8
  %.9240.not.i65 = icmp slt i64 %.401, 1
  br i1 %.9240.not.i65, label %B950, label %iter.check.i66

iter.check.i66:
  %min.iters.check.i67 = icmp samesign ult i64 %.401, 4
  br i1 %min.iters.check.i67, label %iter.check.i66.B40.i110.preheader_crit_edge, label %vector.main.loop.iter.check.i68

iter.check.i66.B40.i110.preheader_crit_edge:
  %.pre = inttoptr i64 %.397 to ptr
  br label %B40.i110.preheader

vector.main.loop.iter.check.i68:
  %min.iters.check1.i69 = icmp samesign ult i64 %.401, 16
  br i1 %min.iters.check1.i69, label %vector.main.loop.iter.check.i68.vec.epilog.ph.i95_crit_edge, label %vector.ph.i70

vector.main.loop.iter.check.i68.vec.epilog.ph.i95_crit_edge:
  %.pre29 = inttoptr i64 %.397 to ptr
  br label %vec.epilog.ph.i95

vector.ph.i70:
  %n.vec.i71 = and i64 %.401, 9223372036854775792
  %sunkaddr275 = inttoptr i64 %.397 to ptr
  br label %vector.body.i72

vector.body.i72:
  %index.i73 = phi i64 [ 0, %vector.ph.i70 ], [ %index.next.i87, %vector.body.i72 ]
  %vec.phi.i74 = phi <4 x i1> [ splat (i1 true), %vector.ph.i70 ], [ %65, %vector.body.i72 ]
  %vec.phi2.i75 = phi <4 x i1> [ splat (i1 true), %vector.ph.i70 ], [ %66, %vector.body.i72 ]
  %vec.phi3.i76 = phi <4 x i1> [ splat (i1 true), %vector.ph.i70 ], [ %67, %vector.body.i72 ]
  %vec.phi4.i77 = phi <4 x i1> [ splat (i1 true), %vector.ph.i70 ], [ %68, %vector.body.i72 ]
  %sunkaddr276 = shl i64 %index.i73, 3
  %sunkaddr277 = getelementptr i8, ptr %sunkaddr275, i64 %sunkaddr276
  %wide.load.i80 = load <4 x double>, ptr %sunkaddr277, align 8, !noalias !160
  %sunkaddr281 = getelementptr i8, ptr %sunkaddr277, i64 32
  %wide.load5.i82 = load <4 x double>, ptr %sunkaddr281, align 8, !noalias !160
  %sunkaddr285 = getelementptr i8, ptr %sunkaddr277, i64 64
  %wide.load6.i84 = load <4 x double>, ptr %sunkaddr285, align 8, !noalias !160
  %sunkaddr289 = getelementptr i8, ptr %sunkaddr277, i64 96
  %wide.load7.i86 = load <4 x double>, ptr %sunkaddr289, align 8, !noalias !160
  %57 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load.i80)
  %58 = fcmp one <4 x double> %57, splat (double 0x7FF0000000000000)
  %59 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load5.i82)
  %60 = fcmp one <4 x double> %59, splat (double 0x7FF0000000000000)
  %61 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load6.i84)
  %62 = fcmp one <4 x double> %61, splat (double 0x7FF0000000000000)
  %63 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load7.i86)
  %64 = fcmp one <4 x double> %63, splat (double 0x7FF0000000000000)
  %65 = and <4 x i1> %vec.phi.i74, %58
  %66 = and <4 x i1> %vec.phi2.i75, %60
  %67 = and <4 x i1> %vec.phi3.i76, %62
  %68 = and <4 x i1> %vec.phi4.i77, %64
  %index.next.i87 = add nuw nsw i64 %index.i73, 16
  %69 = icmp eq i64 %n.vec.i71, %index.next.i87
  br i1 %69, label %middle.block.i88, label %vector.body.i72, !llvm.loop !154

middle.block.i88:
  %bin.rdx.i89 = and <4 x i1> %65, %66
  %bin.rdx8.i90 = and <4 x i1> %67, %bin.rdx.i89
  %bin.rdx9.i91 = and <4 x i1> %68, %bin.rdx8.i90
  %70 = bitcast <4 x i1> %bin.rdx9.i91 to i4
  %71 = icmp eq i4 %70, -1
  %cmp.n.i92 = icmp eq i64 %.401, %n.vec.i71
  br i1 %cmp.n.i92, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit121, label %vec.epilog.iter.check.i93

vec.epilog.iter.check.i93:
  %72 = and i64 %.401, 12
  %min.epilog.iters.check.i94 = icmp eq i64 %72, 0
  br i1 %min.epilog.iters.check.i94, label %B40.i110.preheader, label %vec.epilog.ph.i95, !prof !20

vec.epilog.ph.i95:
  %.pre-phi30 = phi ptr [ %.pre29, %vector.main.loop.iter.check.i68.vec.epilog.ph.i95_crit_edge ], [ %sunkaddr275, %vec.epilog.iter.check.i93 ]
  %vec.epilog.resume.val.i96 = phi i64 [ 0, %vector.main.loop.iter.check.i68.vec.epilog.ph.i95_crit_edge ], [ %n.vec.i71, %vec.epilog.iter.check.i93 ]
  %bc.merge.rdx.i97 = phi i1 [ true, %vector.main.loop.iter.check.i68.vec.epilog.ph.i95_crit_edge ], [ %71, %vec.epilog.iter.check.i93 ]
  %n.vec11.i98 = and i64 %.401, 9223372036854775804
  %73 = insertelement <4 x i1> <i1 poison, i1 true, i1 true, i1 true>, i1 %bc.merge.rdx.i97, i64 0
  br label %vec.epilog.vector.body.i99

vec.epilog.vector.body.i99:
  %index12.i100 = phi i64 [ %vec.epilog.resume.val.i96, %vec.epilog.ph.i95 ], [ %index.next15.i104, %vec.epilog.vector.body.i99 ]
  %vec.phi13.i101 = phi <4 x i1> [ %73, %vec.epilog.ph.i95 ], [ %77, %vec.epilog.vector.body.i99 ]
  %74 = shl i64 %index12.i100, 3
  %scevgep28.i102 = getelementptr i8, ptr %.pre-phi30, i64 %74
  %wide.load14.i103 = load <4 x double>, ptr %scevgep28.i102, align 8, !noalias !160
  %75 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load14.i103)
  %76 = fcmp one <4 x double> %75, splat (double 0x7FF0000000000000)
  %77 = and <4 x i1> %vec.phi13.i101, %76
  %index.next15.i104 = add nuw i64 %index12.i100, 4
  %78 = icmp eq i64 %n.vec11.i98, %index.next15.i104
  br i1 %78, label %vec.epilog.middle.block.i105, label %vec.epilog.vector.body.i99, !llvm.loop !155

vec.epilog.middle.block.i105:
  %79 = bitcast <4 x i1> %77 to i4
  %80 = icmp eq i4 %79, -1
  %cmp.n16.i106 = icmp eq i64 %.401, %n.vec11.i98
  br i1 %cmp.n16.i106, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit121, label %B40.i110.preheader

B40.i110.preheader:
  %.pre-phi = phi ptr [ %.pre, %iter.check.i66.B40.i110.preheader_crit_edge ], [ %.pre-phi30, %vec.epilog.middle.block.i105 ], [ %sunkaddr275, %vec.epilog.iter.check.i93 ]
  %good.2.043.i111.ph = phi i1 [ true, %iter.check.i66.B40.i110.preheader_crit_edge ], [ %80, %vec.epilog.middle.block.i105 ], [ %71, %vec.epilog.iter.check.i93 ]
  %.983941.i112.ph = phi i64 [ 0, %iter.check.i66.B40.i110.preheader_crit_edge ], [ %n.vec11.i98, %vec.epilog.middle.block.i105 ], [ %n.vec.i71, %vec.epilog.iter.check.i93 ]
  br label %B40.i110

B40.i110:
  %good.2.043.i111 = phi i1 [ %.136.i116, %B40.i110 ], [ %good.2.043.i111.ph, %B40.i110.preheader ]
  %.983941.i112 = phi i64 [ %.105.i113, %B40.i110 ], [ %.983941.i112.ph, %B40.i110.preheader ]
  %.105.i113 = add nuw nsw i64 %.983941.i112, 1
  %81 = shl i64 %.983941.i112, 3
  %scevgep.i114 = getelementptr i8, ptr %.pre-phi, i64 %81
  %.132.i115 = load double, ptr %scevgep.i114, align 8, !noalias !160
  %82 = call double @llvm.fabs.f64(double %.132.i115)
  %83 = fcmp one double %82, 0x7FF0000000000000
  %.136.i116 = and i1 %good.2.043.i111, %83
  %exitcond.not.i117 = icmp eq i64 %.401, %.105.i113
  br i1 %exitcond.not.i117, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit121, label %B40.i110, !llvm.loop !156

_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit121:
  %.136.lcssa.i119 = phi i1 [ %80, %vec.epilog.middle.block.i105 ], [ %71, %middle.block.i88 ], [ %.136.i116, %B40.i110 ]
  br i1 %.136.lcssa.i119, label %B950, label %B920.endif

B950:
  store i64 0, ptr %retptr, align 8
  br label %common.ret

B496.endif:
  %.8.i1 = getelementptr i8, ptr %arg.r, i64 496
  %.9.i2 = load i64, ptr %.8.i1, align 8, !noalias !163
  %.10.i3 = icmp eq i64 %.9.i2, 0
  %spec.select.i = select i1 %.10.i3, i64 4, i64 %.9.i2
  store i64 %spec.select.i, ptr %retptr, align 8
  br label %common.ret

B526.endif:
  switch i32 %.228, label %B526.endif.if.if [
    i32 -2, label %B574
    i32 0, label %B574
  ], !prof !8

B526.endif.thread:
  switch i32 %.228, label %B526.endif.if.if [
    i32 -2, label %B560
    i32 0, label %B560
  ], !prof !8

B526.endif.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B726.endif:
  %.8.i61 = getelementptr i8, ptr %arg.r, i64 496
  %.9.i62 = load i64, ptr %.8.i61, align 8, !noalias !166
  %.10.i63 = icmp eq i64 %.9.i62, 0
  %spec.select.i64 = select i1 %.10.i63, i64 4, i64 %.9.i62
  store i64 %spec.select.i64, ptr %retptr, align 8
  br label %common.ret

B920.endif:
  %.8.i122 = getelementptr i8, ptr %arg.r, i64 496
  %.9.i123 = load i64, ptr %.8.i122, align 8, !noalias !169
  %.10.i124 = icmp eq i64 %.9.i123, 0
  %spec.select.i125 = select i1 %.10.i124, i64 4, i64 %.9.i123
  store i64 %spec.select.i125, ptr %retptr, align 8
  br label %common.ret
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels4slowB3v57B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.r, double %arg.t, ptr readonly %arg.x) local_unnamed_addr #0 {
B0.endif:
  %.12 = getelementptr i8, ptr %arg.r, i64 72
  %.13 = load i64, ptr %.12, align 8
  %.10248.not = icmp slt i64 %.13, 1
  br i1 %.10248.not, label %B200, label %B54.lr.ph

B54.lr.ph:
  %xtraiter = and i64 %.13, 3
  %0 = icmp samesign ult i64 %.13, 4
  br i1 %0, label %B54.lr.ph.B54.epil.preheader_crit_edge, label %B54.lr.ph.new

B54.lr.ph.B54.epil.preheader_crit_edge:
  %.pre = shl nuw nsw i64 %.13, 3
  br label %B54.epil.preheader

B54.lr.ph.new:
  %unroll_iter = and i64 %.13, 9223372036854775804
  %1 = shl i64 %.13, 3
  %scevgep29 = getelementptr i8, ptr %arg.x, i64 24
  %scevgep37 = getelementptr i8, ptr %scevgep29, i64 %1
  %sunkaddr44 = getelementptr i8, ptr %arg.r, i64 296
  %sunkaddr = getelementptr i8, ptr %arg.r, i64 264
  br label %B54

B54:
  %fits.2.051 = phi i1 [ true, %B54.lr.ph.new ], [ %"$phi196.1.3.1.3", %B196.3 ]
  %.1084749 = phi i64 [ 0, %B54.lr.ph.new ], [ %.115.35, %B196.3 ]
  br i1 %fits.2.051, label %B60, label %B196.3

B60:
  %2 = shl i64 %.1084749, 3
  %scevgep38 = getelementptr i8, ptr %scevgep37, i64 %2
  %scevgep43 = getelementptr i8, ptr %scevgep38, i64 -24
  %.156 = load double, ptr %scevgep43, align 8
  %.157 = tail call double @llvm.fabs.f64(double %.156)
  %.160 = load i64, ptr %sunkaddr44, align 8
  %.161 = inttoptr i64 %.160 to ptr
  %scevgep21 = getelementptr i8, ptr %.161, i64 24
  %scevgep22 = getelementptr i8, ptr %scevgep21, i64 %2
  %scevgep23 = getelementptr i8, ptr %scevgep22, i64 -24
  %.164 = load double, ptr %scevgep23, align 8
  %.165 = fcmp ugt double %.157, %.164
  br i1 %.165, label %B196.3, label %B196

B196:
  %scevgep35 = getelementptr i8, ptr %scevgep29, i64 %2
  %scevgep36 = getelementptr i8, ptr %scevgep35, i64 -24
  %.172 = load double, ptr %scevgep36, align 8
  %.175 = tail call double @llvm.fabs.f64(double %.172)
  %.179 = load double, ptr %sunkaddr, align 8
  %.180 = fcmp ugt double %.175, %.179
  br i1 %.180, label %B196.3, label %B60.1

B60.1:
  %scevgep42 = getelementptr i8, ptr %scevgep38, i64 -16
  %.156.1 = load double, ptr %scevgep42, align 8
  %.157.1 = tail call double @llvm.fabs.f64(double %.156.1)
  %scevgep20 = getelementptr i8, ptr %scevgep22, i64 -16
  %.164.1 = load double, ptr %scevgep20, align 8
  %.165.1 = fcmp ugt double %.157.1, %.164.1
  br i1 %.165.1, label %B196.3, label %B196.1

B196.1:
  %scevgep34 = getelementptr i8, ptr %scevgep35, i64 -16
  %.172.1 = load double, ptr %scevgep34, align 8
  %.175.1 = tail call double @llvm.fabs.f64(double %.172.1)
  %.180.1 = fcmp ugt double %.175.1, %.179
  br i1 %.180.1, label %B196.3, label %B60.2

B60.2:
  %scevgep40 = getelementptr i8, ptr %scevgep38, i64 -8
  %.156.2 = load double, ptr %scevgep40, align 8
  %.157.2 = tail call double @llvm.fabs.f64(double %.156.2)
  %scevgep17 = getelementptr i8, ptr %scevgep22, i64 -8
  %.164.2 = load double, ptr %scevgep17, align 8
  %.165.2 = fcmp ugt double %.157.2, %.164.2
  br i1 %.165.2, label %B196.3, label %B196.2

B196.2:
  %scevgep32 = getelementptr i8, ptr %scevgep35, i64 -8
  %.172.2 = load double, ptr %scevgep32, align 8
  %.175.2 = tail call double @llvm.fabs.f64(double %.172.2)
  %.180.2 = fcmp ugt double %.175.2, %.179
  br i1 %.180.2, label %B196.3, label %B60.3

B60.3:
  %.156.3 = load double, ptr %scevgep38, align 8
  %.157.3 = tail call double @llvm.fabs.f64(double %.156.3)
  %.164.3 = load double, ptr %scevgep22, align 8
  %.165.3 = fcmp ugt double %.157.3, %.164.3
  br i1 %.165.3, label %B196.3, label %B138.3

B138.3:
  %.172.3 = load double, ptr %scevgep35, align 8
  %.175.3 = tail call double @llvm.fabs.f64(double %.172.3)
  %.180.3 = fcmp ole double %.175.3, %.179
  br label %B196.3

B196.3:
  %"$phi196.1.3.1.3" = phi i1 [ %.180.3, %B138.3 ], [ false, %B60.3 ], [ false, %B196.2 ], [ false, %B60.2 ], [ false, %B196.1 ], [ false, %B60.1 ], [ false, %B196 ], [ false, %B60 ], [ false, %B54 ]
  %.115.35 = add nuw nsw i64 %.1084749, 4
  %niter.ncmp.3 = icmp eq i64 %unroll_iter, %.115.35
  br i1 %niter.ncmp.3, label %B200.loopexit.unr-lcssa, label %B54

B200.loopexit.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B200.loopexit, label %B54.epil.preheader

B54.epil.preheader:
  %.pre-phi = phi i64 [ %.pre, %B54.lr.ph.B54.epil.preheader_crit_edge ], [ %1, %B200.loopexit.unr-lcssa ]
  %fits.2.051.epil.init = phi i1 [ true, %B54.lr.ph.B54.epil.preheader_crit_edge ], [ %"$phi196.1.3.1.3", %B200.loopexit.unr-lcssa ]
  %.1084749.epil.init = phi i64 [ 0, %B54.lr.ph.B54.epil.preheader_crit_edge ], [ %unroll_iter, %B200.loopexit.unr-lcssa ]
  %scevgep4 = getelementptr i8, ptr %arg.x, i64 %.pre-phi
  %sunkaddr49 = getelementptr i8, ptr %arg.r, i64 296
  %sunkaddr50 = getelementptr i8, ptr %arg.r, i64 264
  br label %B54.epil

B54.epil:
  %lsr.iv = phi i64 [ %lsr.iv.next, %B196.epil ], [ %xtraiter, %B54.epil.preheader ]
  %fits.2.051.epil = phi i1 [ %"$phi196.1.3.1.epil", %B196.epil ], [ %fits.2.051.epil.init, %B54.epil.preheader ]
  %.1084749.epil = phi i64 [ %.115.epil, %B196.epil ], [ %.1084749.epil.init, %B54.epil.preheader ]
  br i1 %fits.2.051.epil, label %B60.epil, label %B196.epil

B60.epil:
  %3 = shl i64 %.1084749.epil, 3
  %scevgep5 = getelementptr i8, ptr %scevgep4, i64 %3
  %.156.epil = load double, ptr %scevgep5, align 8
  %.157.epil = tail call double @llvm.fabs.f64(double %.156.epil)
  %.160.epil = load i64, ptr %sunkaddr49, align 8
  %.161.epil = inttoptr i64 %.160.epil to ptr
  %scevgep8 = getelementptr i8, ptr %.161.epil, i64 %3
  %.164.epil = load double, ptr %scevgep8, align 8
  %.165.epil = fcmp ugt double %.157.epil, %.164.epil
  br i1 %.165.epil, label %B196.epil, label %B138.epil

B138.epil:
  %scevgep7 = getelementptr i8, ptr %arg.x, i64 %3
  %.172.epil = load double, ptr %scevgep7, align 8
  %.175.epil = tail call double @llvm.fabs.f64(double %.172.epil)
  %.179.epil = load double, ptr %sunkaddr50, align 8
  %.180.epil = fcmp ole double %.175.epil, %.179.epil
  br label %B196.epil

B196.epil:
  %"$phi196.1.3.1.epil" = phi i1 [ %.180.epil, %B138.epil ], [ false, %B60.epil ], [ false, %B54.epil ]
  %lsr.iv.next = add nsw i64 %lsr.iv, -1
  %.115.epil = add nuw nsw i64 %.1084749.epil, 1
  %epil.iter.cmp.not = icmp eq i64 %lsr.iv.next, 0
  br i1 %epil.iter.cmp.not, label %B200.loopexit, label %B54.epil, !llvm.loop !172

B200.loopexit:
  %"$phi196.1.3.1.lcssa" = phi i1 [ %"$phi196.1.3.1.3", %B200.loopexit.unr-lcssa ], [ %"$phi196.1.3.1.epil", %B196.epil ]
  %4 = zext i1 %"$phi196.1.3.1.lcssa" to i8
  br label %B200

B200:
  %fits.2.0.lcssa = phi i8 [ 1, %B0.endif ], [ %4, %B200.loopexit ]
  store i8 %fits.2.0.lcssa, ptr %retptr, align 1
  ret i32 0
}


define i64 @fixed(ptr %.1, double %.2, double %.3, i64 %.4) local_unnamed_addr #0 {
entry:
  %.6 = alloca i64, align 8
  store i64 0, ptr %.6, align 8
  %excinfo = alloca ptr, align 8
  %.10 = call i32 @_ZN18biped_adrc_kernels5fixedB3v56B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2addx(ptr nonnull %.6, ptr nonnull %excinfo, ptr %.1, double %.2, double %.3, i64 %.4) #0
  %cond = icmp eq i32 %.10, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.20 = load i64, ptr %.6, align 8
  ret i64 %.20
}

define i32 @_ZN18biped_adrc_kernels7throughB3v58B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr initializes((512, 520)) %arg.r, double %arg.t_next) local_unnamed_addr {
B0:
  %.185 = alloca ptr, align 8
  %excinfo.3 = alloca ptr, align 8
  %.484 = alloca i64, align 8
  store i64 0, ptr %.484, align 8
  %excinfo.7 = alloca ptr, align 8
  store ptr null, ptr %excinfo.7, align 8
  %.559 = alloca ptr, align 8
  %excinfo.8 = alloca ptr, align 8
  %.594 = alloca ptr, align 8
  %excinfo.9 = alloca ptr, align 8
  store ptr null, ptr %excinfo.9, align 8
  %.11 = getelementptr i8, ptr %arg.r, i64 424
  %.12 = load i64, ptr %.11, align 8
  store i64 0, ptr %.11, align 8
  %.20 = icmp eq i64 %.12, 0
  br i1 %.20, label %B46, label %B0.B70_crit_edge

B0.B70_crit_edge:
  %.32.phi.trans.insert = getelementptr i8, ptr %arg.r, i64 432
  %.34.pre = load double, ptr %.32.phi.trans.insert, align 8
  %.36.phi.trans.insert = getelementptr i8, ptr %arg.r, i64 344
  %.38.pre = load double, ptr %.36.phi.trans.insert, align 8
  br label %for.end.endif

B46:
  %.23 = getelementptr i8, ptr %arg.r, i64 344
  %.25 = load double, ptr %.23, align 8
  %.27 = getelementptr i8, ptr %arg.r, i64 432
  store double %.25, ptr %.27, align 8
  br label %for.end.endif

B266:
  %.178 = fsub double %arg.t_next, %.38
  %"$phi316.4.2.0" = select i1 %.12.i, double %.101, double %.178
  %.189 = call i32 @_ZN18biped_adrc_kernels5beginB3v61B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add(ptr nonnull %.185, ptr nonnull %excinfo.3, ptr nonnull %arg.r, double %.38, double %"$phi316.4.2.0")
  %cond = icmp eq i32 %.189, 0
  br i1 %cond, label %B316.endif, label %B316.if.if, !prof !24

B388:
  %.277 = fcmp olt double %.38, %arg.t_next
  br i1 %.277, label %B402.preheader, label %B1110

B402.preheader:
  %sunkaddr = getelementptr i8, ptr %arg.r, i64 144
  %sunkaddr98 = getelementptr i8, ptr %arg.r, i64 344
  %sunkaddr100 = getelementptr i8, ptr %arg.r, i64 400
  %sunkaddr107 = getelementptr i8, ptr %arg.r, i64 64
  %sunkaddr101 = getelementptr i8, ptr %arg.r, i64 208
  %sunkaddr102 = getelementptr i8, ptr %arg.r, i64 696
  %sunkaddr103 = getelementptr i8, ptr %arg.r, i64 704
  %sunkaddr104 = getelementptr i8, ptr %arg.r, i64 416
  br label %B402

B402:
  %steps.2.0 = phi i64 [ %0, %B1096 ], [ %.12, %B402.preheader ]
  %t.2.0 = phi double [ %t1.2.182, %B1096 ], [ %.38, %B402.preheader ]
  %skipped.3.0 = phi i64 [ %skipped.4.1, %B1096 ], [ 0, %B402.preheader ]
  %0 = add i64 %steps.2.0, 1
  %.293 = load i64, ptr %sunkaddr, align 8
  %.294 = icmp eq i64 %.293, 2
  br i1 %.294, label %B444, label %B478

B444:
  %.8.i = load double, ptr %sunkaddr98, align 8, !noalias !173
  br label %B602

B478:
  %.337 = sitofp i64 %0 to double
  %.338 = fcmp ogt double %.13.i, %.337
  br i1 %.338, label %B490, label %B590

B490:
  %.343 = load double, ptr %.99, align 8
  %.346 = fmul double %.343, %.337
  %.348 = fadd double %.34, %.346
  br label %B590

B590:
  %"$phi518.0.2.1" = phi double [ %.348, %B490 ], [ %arg.t_next, %B478 ]
  %.365 = fcmp ole double %.13.i, %.337
  %.15.i16 = zext i1 %.365 to i64
  %.393 = tail call i64 @fixed(ptr nonnull %arg.r, double %t.2.0, double %"$phi518.0.2.1", i64 %.15.i16)
  %.398.not = icmp eq i64 %.393, 0
  br i1 %.398.not, label %B602, label %B664

B602:
  %t1.2.182 = phi double [ %"$phi518.0.2.1", %B590 ], [ %.8.i, %B444 ]
  %.402 = fcmp ole double %t1.2.182, %t.2.0
  %.405 = icmp sgt i64 %steps.2.0, 9999999
  %or.cond = select i1 %.402, i1 true, i1 %.405
  br i1 %or.cond, label %B664, label %B666

common.ret:
  %common.ret.op = phi i32 [ 0, %B664 ], [ 0, %B768 ], [ 0, %B1068 ], [ 0, %B1110 ], [ %.598, %B874.if.if ], [ %.563, %B836.if.if ], [ %.189, %B316.if.if ], [ %.488, %B738.if.if ]
  ret i32 %common.ret.op

B664:
  %"$phi664.0.2.0" = phi i64 [ %.393, %B590 ], [ 6, %B602 ]
  store i64 %"$phi664.0.2.0", ptr %retptr, align 8
  br label %common.ret

B666:
  %.448 = tail call i64 @event(ptr nonnull %arg.r, double %t.2.0, double %t1.2.182)
  switch i64 %.448, label %B738 [
    i64 0, label %B770
    i64 7, label %B768
  ]

B738:
  store i64 0, ptr %.484, align 8
  %.488 = call i32 @_ZN18biped_adrc_kernels4stopB3v66B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax(ptr nonnull %.484, ptr nonnull %excinfo.7, ptr nonnull %arg.r, i64 %.448)
  %.498 = load i64, ptr %.484, align 8
  %cond17 = icmp eq i32 %.488, 0
  br i1 %cond17, label %B768, label %B738.if.if, !prof !24

B768:
  %"$phi768.0.2.0" = phi i64 [ %.498, %B738 ], [ %.448, %B666 ]
  store i64 %"$phi768.0.2.0", ptr %retptr, align 8
  br label %common.ret

B770:
  %.521 = add nsw i64 %skipped.3.0, 1
  %.533 = load i64, ptr %sunkaddr100, align 8
  %.534 = icmp sgt i64 %.533, 0
  br i1 %.534, label %B802, label %B874

B802:
  %.540 = fcmp oge double %t1.2.182, %arg.t_next
  %.549 = icmp sge i64 %.521, %.533
  %or.cond89 = select i1 %.540, i1 true, i1 %.549
  br i1 %or.cond89, label %B836, label %B874

B836:
  %.563 = call i32 @_ZN18biped_adrc_kernels5nodesB3v67B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add(ptr nonnull %.559, ptr nonnull %excinfo.8, ptr nonnull %arg.r, double %t.2.0, double %t1.2.182)
  %cond18 = icmp eq i32 %.563, 0
  br i1 %cond18, label %B874, label %B836.if.if, !prof !24

B874:
  %skipped.4.1 = phi i64 [ %.521, %B770 ], [ %.521, %B802 ], [ 0, %B836 ]
  %.598 = call i32 @_ZN18biped_adrc_kernels7pass_onB3v68B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a(ptr nonnull %.594, ptr nonnull %excinfo.9, ptr nonnull %arg.r)
  %cond19 = icmp eq i32 %.598, 0
  br i1 %cond19, label %B874.endif, label %B874.if.if, !prof !24

B944:
  %.636 = fcmp olt double %t1.2.182, %arg.t_next
  br i1 %.636, label %B978, label %B956

B956:
  %.640 = load i64, ptr %sunkaddr101, align 8
  %.641.not = icmp eq i64 %.640, 0
  br i1 %.641.not, label %B1034, label %B978

B978:
  %.645 = load i64, ptr %sunkaddr102, align 8
  %.646 = inttoptr i64 %.645 to ptr
  %.649 = load i64, ptr %sunkaddr103, align 8
  %.650 = inttoptr i64 %.649 to ptr
  %.653 = tail call ptr @node(ptr nonnull %arg.r, double %t1.2.182, ptr %.646, ptr %.650)
  br label %B1034

B1034:
  %.657 = load i64, ptr %sunkaddr104, align 8
  %.658 = icmp ne i64 %.657, 0
  %.662 = fcmp olt double %t1.2.182, %arg.t_next
  %or.cond90 = select i1 %.658, i1 %.662, i1 false
  br i1 %or.cond90, label %B1068, label %B1096

B1068:
  store i64 %0, ptr %.11, align 8
  store i64 10, ptr %retptr, align 8
  br label %common.ret

B1096:
  br i1 %.662, label %B402, label %B1110

B1110:
  store i64 0, ptr %retptr, align 8
  br label %common.ret

for.end.endif:
  %.38 = phi double [ %.38.pre, %B0.B70_crit_edge ], [ %.25, %B46 ]
  %.34 = phi double [ %.34.pre, %B0.B70_crit_edge ], [ %.25, %B46 ]
  %.15.i = tail call double @nextafter(double %arg.t_next, double 0xFFF0000000000000), !noalias !176
  %.92 = getelementptr i8, ptr %arg.r, i64 512
  store double %.15.i, ptr %.92, align 8
  %.97 = fsub double %arg.t_next, %.34
  %.99 = getelementptr i8, ptr %arg.r, i64 248
  %.101 = load double, ptr %.99, align 8
  %.105 = fdiv double %.97, %.101
  %.106 = fadd double %.105, -1.000000e-09
  %.114.le = tail call double @llvm.ceil.f64(double %.106)
  %.12.i = fcmp ogt double %.114.le, 1.000000e+00
  %.13.i = select i1 %.12.i, double %.114.le, double 1.000000e+00
  br i1 %.20, label %B266, label %B388

B316.endif:
  %.219 = getelementptr i8, ptr %arg.r, i64 696
  %.220 = load i64, ptr %.219, align 8
  %.223 = getelementptr i8, ptr %arg.r, i64 704
  %.224 = load i64, ptr %.223, align 8
  %.17.i = getelementptr i8, ptr %arg.r, i64 400
  %.18.i = load i64, ptr %.17.i, align 8, !noalias !179
  %.19.i = icmp sgt i64 %.18.i, 0
  br i1 %.19.i, label %B48.i, label %B26.i

B26.i:
  %.22.i = getelementptr i8, ptr %arg.r, i64 64
  %.23.i = load i64, ptr %.22.i, align 8, !noalias !179
  %.24.not.i = icmp eq i64 %.23.i, 0
  br i1 %.24.not.i, label %B388, label %B48.i

B48.i:
  %1 = inttoptr i64 %.224 to ptr
  %2 = inttoptr i64 %.220 to ptr
  %.30.i = tail call ptr @node(ptr nonnull %arg.r, double %.38, ptr %2, ptr %1), !noalias !179
  br label %B388

B316.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B738.if.if:
  %.496 = icmp sgt i32 %.488, 0
  %.489 = load ptr, ptr %excinfo.7, align 8
  %.497 = select i1 %.496, ptr %.489, ptr undef
  store ptr %.497, ptr %excinfo, align 8
  br label %common.ret

B836.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B874.endif:
  store double %t1.2.182, ptr %sunkaddr98, align 8
  %.631 = load i64, ptr %sunkaddr107, align 8
  %.632.not = icmp eq i64 %.631, 0
  br i1 %.632.not, label %B1034, label %B944

B874.if.if:
  %.606 = icmp sgt i32 %.598, 0
  %.599 = load ptr, ptr %excinfo.9, align 8
  %.607 = select i1 %.606, ptr %.599, ptr undef
  store ptr %.607, ptr %excinfo, align 8
  br label %common.ret
}

define linkonce_odr i32 @_ZN18biped_adrc_kernels5beginB3v61B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add(ptr noalias writeonly initializes((0, 8)) %retptr, ptr noalias readnone %excinfo, ptr %arg.r, double %arg.t, double %arg.h) local_unnamed_addr {
B0:
  %.14 = getelementptr i8, ptr %arg.r, i64 144
  %.15 = load i64, ptr %.14, align 8
  %.16 = icmp eq i64 %.15, 1
  br i1 %.16, label %B36.endif, label %B146

B146:
  %.68 = phi i64 [ %.68.pr, %B36.endif ], [ %.15, %B0 ]
  switch i64 %.68, label %B314 [
    i64 0, label %B178
    i64 1, label %B292
  ]

B178:
  %.72 = getelementptr i8, ptr %arg.r, i64 160
  %.73 = load i64, ptr %.72, align 8
  %.74 = icmp sgt i64 %.73, 0
  br i1 %.74, label %B200, label %B314

B200:
  %.77 = getelementptr i8, ptr %arg.r, i64 696
  %.78 = load i64, ptr %.77, align 8
  %.79 = inttoptr i64 %.78 to ptr
  %.81 = getelementptr i8, ptr %arg.r, i64 704
  %.82 = load i64, ptr %.81, align 8
  %.83 = inttoptr i64 %.82 to ptr
  %.87 = tail call ptr @lagging(ptr nonnull %arg.r, double %arg.t, ptr %.79, double %arg.h, ptr %.83)
  br label %common.ret

B292:
  %.101 = getelementptr i8, ptr %arg.r, i64 400
  %.102 = load i64, ptr %.101, align 8
  %.103 = icmp sgt i64 %.102, 0
  br i1 %.103, label %B314, label %common.ret

B314:
  %.106 = getelementptr i8, ptr %arg.r, i64 464
  %.107 = load i64, ptr %.106, align 8
  %.108 = icmp eq i64 %.107, 0
  br i1 %.108, label %B336, label %common.ret

B336:
  %.111 = getelementptr i8, ptr %arg.r, i64 696
  %.112 = load i64, ptr %.111, align 8
  %.113 = inttoptr i64 %.112 to ptr
  %.115 = getelementptr i8, ptr %arg.r, i64 704
  %.116 = load i64, ptr %.115, align 8
  %.117 = inttoptr i64 %.116 to ptr
  %.120 = tail call ptr @flow(ptr nonnull %arg.r, double %arg.t, ptr %.113, ptr %.117)
  br label %common.ret

common.ret:
  %.127 = getelementptr i8, ptr %arg.r, i64 464
  store i64 0, ptr %.127, align 8
  store ptr null, ptr %retptr, align 8
  ret i32 0

B36.endif:
  %.20 = getelementptr i8, ptr %arg.r, i64 696
  %.21 = load i64, ptr %.20, align 8
  %.22 = inttoptr i64 %.21 to ptr
  %.24 = getelementptr i8, ptr %arg.r, i64 800
  %.25 = load i64, ptr %.24, align 8
  %.26 = inttoptr i64 %.25 to ptr
  %.7.i = getelementptr i8, ptr %arg.r, i64 32
  %.8.i = load i64, ptr %.7.i, align 8, !noalias !182
  %.9.i = getelementptr i8, ptr %arg.r, i64 272
  %.10.i = load i64, ptr %.9.i, align 8, !noalias !182
  %.11.i = inttoptr i64 %.10.i to ptr
  %.12.i = inttoptr i64 %.8.i to ptr
  tail call void %.12.i(ptr %.11.i, ptr %.22, ptr %.26), !noalias !182
  %.56 = load i64, ptr %.24, align 8
  %.57 = inttoptr i64 %.56 to ptr
  %.59 = getelementptr i8, ptr %arg.r, i64 856
  %.60 = load i64, ptr %.59, align 8
  %.61 = inttoptr i64 %.60 to ptr
  %.64 = tail call ptr @remainder(ptr nonnull %arg.r, double %arg.t, ptr %.57, ptr %.61)
  %.68.pr = load i64, ptr %.14, align 8
  br label %B146
}

define linkonce_odr i32 @_ZN18biped_adrc_kernels4stopB3v66B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r, i64 %arg.code) local_unnamed_addr {
B0:
  %.107 = alloca ptr, align 8
  %excinfo.3 = alloca ptr, align 8
  %.11 = getelementptr i8, ptr %arg.r, i64 520
  %.13 = load double, ptr %.11, align 8
  %.19 = getelementptr i8, ptr %arg.r, i64 768
  %.20 = load i64, ptr %.19, align 8
  %.23 = getelementptr i8, ptr %arg.r, i64 80
  %.24 = load i64, ptr %.23, align 8
  %.9240.not.i = icmp slt i64 %.24, 1
  br i1 %.9240.not.i, label %B100, label %iter.check.i

iter.check.i:
  %min.iters.check.i = icmp samesign ult i64 %.24, 4
  br i1 %min.iters.check.i, label %iter.check.i.B40.i.preheader_crit_edge, label %vector.main.loop.iter.check.i

iter.check.i.B40.i.preheader_crit_edge:
  %.pre = inttoptr i64 %.20 to ptr
  br label %B40.i.preheader

vector.main.loop.iter.check.i:
  %min.iters.check1.i = icmp samesign ult i64 %.24, 16
  br i1 %min.iters.check1.i, label %vector.main.loop.iter.check.i.vec.epilog.ph.i_crit_edge, label %vector.ph.i

vector.main.loop.iter.check.i.vec.epilog.ph.i_crit_edge:
  %.pre13 = inttoptr i64 %.20 to ptr
  br label %vec.epilog.ph.i

vector.ph.i:
  %n.vec.i = and i64 %.24, 9223372036854775792
  %0 = inttoptr i64 %.20 to ptr
  br label %vector.body.i

vector.body.i:
  %index.i = phi i64 [ 0, %vector.ph.i ], [ %index.next.i, %vector.body.i ]
  %vec.phi.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %9, %vector.body.i ]
  %vec.phi2.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %10, %vector.body.i ]
  %vec.phi3.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %11, %vector.body.i ]
  %vec.phi4.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %12, %vector.body.i ]
  %sunkaddr45 = shl i64 %index.i, 3
  %sunkaddr46 = getelementptr i8, ptr %0, i64 %sunkaddr45
  %wide.load.i = load <4 x double>, ptr %sunkaddr46, align 8, !noalias !185
  %sunkaddr50 = getelementptr i8, ptr %sunkaddr46, i64 32
  %wide.load5.i = load <4 x double>, ptr %sunkaddr50, align 8, !noalias !185
  %sunkaddr54 = getelementptr i8, ptr %sunkaddr46, i64 64
  %wide.load6.i = load <4 x double>, ptr %sunkaddr54, align 8, !noalias !185
  %scevgep31 = getelementptr i8, ptr %sunkaddr46, i64 96
  %wide.load7.i = load <4 x double>, ptr %scevgep31, align 8, !noalias !185
  %1 = tail call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load.i)
  %2 = fcmp one <4 x double> %1, splat (double 0x7FF0000000000000)
  %3 = tail call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load5.i)
  %4 = fcmp one <4 x double> %3, splat (double 0x7FF0000000000000)
  %5 = tail call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load6.i)
  %6 = fcmp one <4 x double> %5, splat (double 0x7FF0000000000000)
  %7 = tail call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load7.i)
  %8 = fcmp one <4 x double> %7, splat (double 0x7FF0000000000000)
  %9 = and <4 x i1> %vec.phi.i, %2
  %10 = and <4 x i1> %vec.phi2.i, %4
  %11 = and <4 x i1> %vec.phi3.i, %6
  %12 = and <4 x i1> %vec.phi4.i, %8
  %index.next.i = add nuw nsw i64 %index.i, 16
  %13 = icmp eq i64 %n.vec.i, %index.next.i
  br i1 %13, label %middle.block.i, label %vector.body.i, !llvm.loop !188

middle.block.i:
  %bin.rdx.i = and <4 x i1> %9, %10
  %bin.rdx8.i = and <4 x i1> %11, %bin.rdx.i
  %bin.rdx9.i = and <4 x i1> %12, %bin.rdx8.i
  %14 = bitcast <4 x i1> %bin.rdx9.i to i4
  %15 = icmp eq i4 %14, -1
  %cmp.n.i = icmp eq i64 %.24, %n.vec.i
  br i1 %cmp.n.i, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit, label %vec.epilog.iter.check.i

vec.epilog.iter.check.i:
  %16 = and i64 %.24, 12
  %min.epilog.iters.check.i = icmp eq i64 %16, 0
  br i1 %min.epilog.iters.check.i, label %B40.i.preheader, label %vec.epilog.ph.i, !prof !20

vec.epilog.ph.i:
  %.pre-phi14 = phi ptr [ %.pre13, %vector.main.loop.iter.check.i.vec.epilog.ph.i_crit_edge ], [ %0, %vec.epilog.iter.check.i ]
  %vec.epilog.resume.val.i = phi i64 [ 0, %vector.main.loop.iter.check.i.vec.epilog.ph.i_crit_edge ], [ %n.vec.i, %vec.epilog.iter.check.i ]
  %bc.merge.rdx.i = phi i1 [ true, %vector.main.loop.iter.check.i.vec.epilog.ph.i_crit_edge ], [ %15, %vec.epilog.iter.check.i ]
  %n.vec11.i = and i64 %.24, 9223372036854775804
  %17 = insertelement <4 x i1> <i1 poison, i1 true, i1 true, i1 true>, i1 %bc.merge.rdx.i, i64 0
  br label %vec.epilog.vector.body.i

vec.epilog.vector.body.i:
  %index12.i = phi i64 [ %vec.epilog.resume.val.i, %vec.epilog.ph.i ], [ %index.next15.i, %vec.epilog.vector.body.i ]
  %vec.phi13.i = phi <4 x i1> [ %17, %vec.epilog.ph.i ], [ %21, %vec.epilog.vector.body.i ]
  %18 = shl i64 %index12.i, 3
  %scevgep28.i = getelementptr i8, ptr %.pre-phi14, i64 %18
  %wide.load14.i = load <4 x double>, ptr %scevgep28.i, align 8, !noalias !185
  %19 = tail call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load14.i)
  %20 = fcmp one <4 x double> %19, splat (double 0x7FF0000000000000)
  %21 = and <4 x i1> %vec.phi13.i, %20
  %index.next15.i = add nuw i64 %index12.i, 4
  %22 = icmp eq i64 %n.vec11.i, %index.next15.i
  br i1 %22, label %vec.epilog.middle.block.i, label %vec.epilog.vector.body.i, !llvm.loop !189

vec.epilog.middle.block.i:
  %23 = bitcast <4 x i1> %21 to i4
  %24 = icmp eq i4 %23, -1
  %cmp.n16.i = icmp eq i64 %.24, %n.vec11.i
  br i1 %cmp.n16.i, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit, label %B40.i.preheader

B40.i.preheader:
  %.pre-phi = phi ptr [ %.pre, %iter.check.i.B40.i.preheader_crit_edge ], [ %0, %vec.epilog.iter.check.i ], [ %.pre-phi14, %vec.epilog.middle.block.i ]
  %good.2.043.i.ph = phi i1 [ true, %iter.check.i.B40.i.preheader_crit_edge ], [ %15, %vec.epilog.iter.check.i ], [ %24, %vec.epilog.middle.block.i ]
  %.983941.i.ph = phi i64 [ 0, %iter.check.i.B40.i.preheader_crit_edge ], [ %n.vec.i, %vec.epilog.iter.check.i ], [ %n.vec11.i, %vec.epilog.middle.block.i ]
  br label %B40.i

B40.i:
  %good.2.043.i = phi i1 [ %.136.i, %B40.i ], [ %good.2.043.i.ph, %B40.i.preheader ]
  %.983941.i = phi i64 [ %.105.i, %B40.i ], [ %.983941.i.ph, %B40.i.preheader ]
  %.105.i = add nuw nsw i64 %.983941.i, 1
  %25 = shl i64 %.983941.i, 3
  %scevgep.i = getelementptr i8, ptr %.pre-phi, i64 %25
  %.132.i = load double, ptr %scevgep.i, align 8, !noalias !185
  %26 = tail call double @llvm.fabs.f64(double %.132.i)
  %27 = fcmp one double %26, 0x7FF0000000000000
  %.136.i = and i1 %good.2.043.i, %27
  %exitcond.not.i = icmp eq i64 %.24, %.105.i
  br i1 %exitcond.not.i, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit, label %B40.i, !llvm.loop !190

_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit:
  %.136.lcssa.i = phi i1 [ %24, %vec.epilog.middle.block.i ], [ %15, %middle.block.i ], [ %.136.i, %B40.i ]
  br i1 %.136.lcssa.i, label %B100, label %B70.endif

B100:
  %28 = inttoptr i64 %.20 to ptr
  %.101 = getelementptr i8, ptr %arg.r, i64 696
  %.102 = load i64, ptr %.101, align 8
  %.103 = inttoptr i64 %.102 to ptr
  %.111 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.107, ptr nonnull %excinfo.3, ptr %28, ptr %.103, i64 %.24)
  switch i32 %.111, label %B100.if.if [
    i32 -2, label %B100.endif
    i32 0, label %B100.endif
  ], !prof !8

common.ret:
  %common.ret.op = phi i32 [ 0, %B200 ], [ %.111, %B100.if.if ], [ 0, %B70.endif ], [ 0, %B308.endif ]
  ret i32 %common.ret.op

B200:
  store i64 %arg.code, ptr %retptr, align 8
  br label %common.ret

B204:
  %.153 = getelementptr i8, ptr %arg.r, i64 400
  %.154 = load i64, ptr %.153, align 8
  %.155 = icmp sgt i64 %.154, 0
  br i1 %.155, label %B308, label %B308.thread

B308.thread:
  %.1974 = load i64, ptr %.101, align 8
  %.1985 = inttoptr i64 %.1974 to ptr
  %.2006 = getelementptr i8, ptr %arg.r, i64 704
  %.2017 = load i64, ptr %.2006, align 8
  %.2028 = inttoptr i64 %.2017 to ptr
  br label %B26.i

B308:
  %.15.i = tail call double @nextafter(double %.13, double 0xFFF0000000000000), !noalias !191
  %.185 = load i64, ptr %.101, align 8
  %.186 = inttoptr i64 %.185 to ptr
  %.188 = getelementptr i8, ptr %arg.r, i64 704
  %.189 = load i64, ptr %.188, align 8
  %.190 = inttoptr i64 %.189 to ptr
  %.192 = tail call ptr @flow(ptr nonnull %arg.r, double %.15.i, ptr %.186, ptr %.190)
  %.18.i.pr = load i64, ptr %.153, align 8, !noalias !194
  %.197 = load i64, ptr %.101, align 8
  %.198 = inttoptr i64 %.197 to ptr
  %.201 = load i64, ptr %.188, align 8
  %.202 = inttoptr i64 %.201 to ptr
  %.19.i = icmp sgt i64 %.18.i.pr, 0
  br i1 %.19.i, label %B48.i, label %B26.i

B26.i:
  %.20212 = phi ptr [ %.2028, %B308.thread ], [ %.202, %B308 ]
  %.19810 = phi ptr [ %.1985, %B308.thread ], [ %.198, %B308 ]
  %.22.i = getelementptr i8, ptr %arg.r, i64 64
  %.23.i = load i64, ptr %.22.i, align 8, !noalias !194
  %.24.not.i = icmp eq i64 %.23.i, 0
  br i1 %.24.not.i, label %B308.endif, label %B48.i

B48.i:
  %.20213 = phi ptr [ %.20212, %B26.i ], [ %.202, %B308 ]
  %.19811 = phi ptr [ %.19810, %B26.i ], [ %.198, %B308 ]
  %.30.i = tail call ptr @node(ptr nonnull %arg.r, double %.13, ptr %.19811, ptr %.20213), !noalias !194
  br label %B308.endif

B70.endif:
  %.8.i = getelementptr i8, ptr %arg.r, i64 496
  %.9.i = load i64, ptr %.8.i, align 8, !noalias !197
  %.10.i = icmp eq i64 %.9.i, 0
  %spec.select.i = select i1 %.10.i, i64 4, i64 %.9.i
  store i64 %spec.select.i, ptr %retptr, align 8
  br label %common.ret

B100.endif:
  %.133 = getelementptr i8, ptr %arg.r, i64 344
  store double %.13, ptr %.133, align 8
  %.137 = getelementptr i8, ptr %arg.r, i64 376
  %.139 = load double, ptr %.137, align 8
  %.141 = fcmp oeq double %.13, %.139
  br i1 %.141, label %B200, label %B204

B100.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B308.endif:
  store i64 %arg.code, ptr %retptr, align 8
  br label %common.ret
}

define linkonce_odr i32 @_ZN18biped_adrc_kernels5nodesB3v67B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr %arg.r, double %arg.t0, double %arg.t1) local_unnamed_addr {
B0:
  %.5.i = alloca ptr, align 8
  %.14 = getelementptr i8, ptr %arg.r, i64 400
  %.15 = load i64, ptr %.14, align 8
  %.16 = icmp eq i64 %.15, 1
  br i1 %.16, label %B60.endif, label %common.ret

B96:
  %.1464648 = phi i64 [ 1, %B96.lr.ph ], [ %.153, %B96 ]
  %.153 = add nuw nsw i64 %.1464648, 1
  %.181 = uitofp nneg i64 %.1464648 to double
  %.182 = fmul double %.6.i, %.181
  %.188 = fdiv double %.182, %.184
  %.190 = fadd double %arg.t0, %.188
  %.9.i = call i32 @_ZN18biped_adrc_kernels6retakeB3v38B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add(ptr nonnull %.5.i, ptr nonnull poison, ptr nonnull %arg.r, double %arg.t0, double %.190) #0
  %.196 = load i64, ptr %sunkaddr2, align 8
  %.197 = inttoptr i64 %.196 to ptr
  %.200 = load i64, ptr %sunkaddr3, align 8
  %.201 = inttoptr i64 %.200 to ptr
  %.203 = tail call ptr @flow(ptr nonnull %arg.r, double %.190, ptr %.197, ptr %.201)
  %.206 = load i64, ptr %sunkaddr2, align 8
  %.207 = inttoptr i64 %.206 to ptr
  %.210 = load i64, ptr %sunkaddr3, align 8
  %.211 = inttoptr i64 %.210 to ptr
  %.213 = tail call ptr @node(ptr nonnull %arg.r, double %.190, ptr %.207, ptr %.211)
  %exitcond.not = icmp eq i64 %.153, %.13.i
  br i1 %exitcond.not, label %common.ret, label %B96

common.ret:
  %.224 = getelementptr i8, ptr %arg.r, i64 712
  %.225 = load i64, ptr %.224, align 8
  %.226 = inttoptr i64 %.225 to ptr
  %.228 = getelementptr i8, ptr %arg.r, i64 720
  %.229 = load i64, ptr %.228, align 8
  %.230 = inttoptr i64 %.229 to ptr
  %.233 = tail call ptr @node(ptr nonnull %arg.r, double %arg.t1, ptr %.226, ptr %.230)
  store ptr null, ptr %retptr, align 8
  ret i32 0

B60.endif:
  %.6.i = fsub double %arg.t1, %arg.t0
  %.10.i = fdiv double %.6.i, 2.000000e-03
  %.11.i = fadd double %.10.i, -1.000000e-09
  %.12.i = tail call double @llvm.ceil.f64(double %.11.i)
  %.13.i = fptosi double %.12.i to i64
  %.14047.not = icmp slt i64 %.13.i, 2
  br i1 %.14047.not, label %common.ret, label %B96.lr.ph

B96.lr.ph:
  %.184 = uitofp nneg i64 %.13.i to double
  %sunkaddr2 = getelementptr i8, ptr %arg.r, i64 768
  %sunkaddr3 = getelementptr i8, ptr %arg.r, i64 776
  br label %B96
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels7pass_onB3v68B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr readonly %arg.r) local_unnamed_addr #0 {
B0:
  %.19 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.57 = alloca ptr, align 8
  %excinfo.2 = alloca ptr, align 8
  %.98 = alloca ptr, align 8
  %excinfo.3 = alloca ptr, align 8
  %.136 = alloca ptr, align 8
  %excinfo.4 = alloca ptr, align 8
  %.9 = getelementptr i8, ptr %arg.r, i64 712
  %.10 = load i64, ptr %.9, align 8
  %.11 = inttoptr i64 %.10 to ptr
  %.13 = getelementptr i8, ptr %arg.r, i64 696
  %.14 = load i64, ptr %.13, align 8
  %.15 = inttoptr i64 %.14 to ptr
  %.17 = getelementptr i8, ptr %arg.r, i64 96
  %.18 = load i64, ptr %.17, align 8
  %.23 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.19, ptr nonnull %excinfo.1, ptr %.11, ptr %.15, i64 %.18)
  switch i32 %.23, label %common.ret [
    i32 -2, label %B0.endif
    i32 0, label %B0.endif
  ], !prof !8

B164:
  %.88 = getelementptr i8, ptr %arg.r, i64 808
  %.89 = load i64, ptr %.88, align 8
  %.90 = inttoptr i64 %.89 to ptr
  %.92 = getelementptr i8, ptr %arg.r, i64 800
  %.93 = load i64, ptr %.92, align 8
  %.94 = inttoptr i64 %.93 to ptr
  %.96 = getelementptr i8, ptr %arg.r, i64 80
  %.97 = load i64, ptr %.96, align 8
  %.102 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.98, ptr nonnull %excinfo.3, ptr %.90, ptr %.94, i64 %.97)
  switch i32 %.102, label %common.ret [
    i32 -2, label %B164.endif
    i32 0, label %B164.endif
  ], !prof !8

common.ret:
  %excinfo.sink = phi ptr [ %excinfo, %B164.endif.if.if ], [ %excinfo, %B164 ], [ %excinfo, %B0.endif ], [ %excinfo, %B0 ], [ %retptr, %B0.endif.endif ], [ %retptr, %B164.endif ], [ %retptr, %B164.endif ]
  %common.ret.op = phi i32 [ %.140, %B164.endif.if.if ], [ %.102, %B164 ], [ %.61, %B0.endif ], [ %.23, %B0 ], [ 0, %B0.endif.endif ], [ 0, %B164.endif ], [ 0, %B164.endif ]
  store ptr null, ptr %excinfo.sink, align 8
  ret i32 %common.ret.op

B0.endif:
  %.47 = getelementptr i8, ptr %arg.r, i64 720
  %.48 = load i64, ptr %.47, align 8
  %.49 = inttoptr i64 %.48 to ptr
  %.51 = getelementptr i8, ptr %arg.r, i64 704
  %.52 = load i64, ptr %.51, align 8
  %.53 = inttoptr i64 %.52 to ptr
  %.56 = load i64, ptr %.17, align 8
  %.61 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.57, ptr nonnull %excinfo.2, ptr %.49, ptr %.53, i64 %.56)
  switch i32 %.61, label %common.ret [
    i32 -2, label %B0.endif.endif
    i32 0, label %B0.endif.endif
  ], !prof !8

B0.endif.endif:
  %.82 = getelementptr i8, ptr %arg.r, i64 144
  %.83 = load i64, ptr %.82, align 8
  %.84 = icmp eq i64 %.83, 1
  br i1 %.84, label %B164, label %common.ret

B164.endif:
  %.124 = getelementptr i8, ptr %arg.r, i64 864
  %.125 = load i64, ptr %.124, align 8
  %.126 = inttoptr i64 %.125 to ptr
  %.128 = getelementptr i8, ptr %arg.r, i64 856
  %.129 = load i64, ptr %.128, align 8
  %.130 = inttoptr i64 %.129 to ptr
  %.132 = getelementptr i8, ptr %arg.r, i64 120
  %.133 = load i64, ptr %.132, align 8
  %.140 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.136, ptr nonnull %excinfo.4, ptr %.126, ptr %.130, i64 %.133)
  switch i32 %.140, label %B164.endif.if.if [
    i32 -2, label %common.ret
    i32 0, label %common.ret
  ], !prof !8

B164.endif.if.if:
  br label %common.ret
}


declare double @nextafter(double, double) local_unnamed_addr #4


define i64 @through(ptr initializes((512, 520)) %.1, double %.2) local_unnamed_addr #0 {
entry:
  %.4 = alloca i64, align 8
  store i64 0, ptr %.4, align 8
  %excinfo = alloca ptr, align 8
  %.8 = call i32 @_ZN18biped_adrc_kernels7throughB3v58B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ad(ptr nonnull %.4, ptr nonnull %excinfo, ptr %.1, double %.2) #0
  %cond = icmp eq i32 %.8, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.18 = load i64, ptr %.4, align 8
  ret i64 %.18
}


define i32 @_ZN18biped_adrc_kernels5go_onB3v69B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr initializes((496, 512)) %arg.r) local_unnamed_addr #0 {
B0:
  %.33.i = alloca double, align 8
  %excinfo.1.i = alloca ptr, align 8
  %.18 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.8 = getelementptr i8, ptr %arg.r, i64 408
  %.9 = load i64, ptr %.8, align 8
  %.14 = getelementptr i8, ptr %arg.r, i64 496
  store i64 0, ptr %.14, align 8
  %.22 = call i32 @_ZN18biped_adrc_kernels5lowerB3v70B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a(ptr nonnull %.18, ptr nonnull %excinfo.1, ptr %arg.r)
  switch i32 %.22, label %B0.if.if [
    i32 -2, label %B0.endif
    i32 0, label %B0.endif
  ], !prof !8

B86:
  %.8.i = getelementptr i8, ptr %arg.r, i64 344
  %.10.i = load double, ptr %.8.i, align 8, !noalias !200
  %.12.i = getelementptr i8, ptr %arg.r, i64 376
  store double %.10.i, ptr %.12.i, align 8, !noalias !200
  %.20.i = getelementptr i8, ptr %arg.r, i64 696
  %.21.i = load i64, ptr %.20.i, align 8, !noalias !200
  %.22.i = inttoptr i64 %.21.i to ptr
  %.24.i = getelementptr i8, ptr %arg.r, i64 672
  %.25.i = load i64, ptr %.24.i, align 8, !noalias !200
  %.26.i = inttoptr i64 %.25.i to ptr
  %.28.i = tail call ptr @watch(ptr nonnull %arg.r, double %.10.i, ptr %.22.i, ptr %.26.i), !noalias !200
  %.30.i = getelementptr i8, ptr %arg.r, i64 384
  %.31.i = load i64, ptr %.30.i, align 8, !noalias !200
  %.32.i = icmp sgt i64 %.31.i, -1
  br i1 %.32.i, label %B116.i, label %_ZN18biped_adrc_kernels3armB3v71B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a.exit

B116.i:
  %.36.i = load i64, ptr %.24.i, align 8, !noalias !200
  %.37.i = inttoptr i64 %.36.i to ptr
  %.41.i = getelementptr double, ptr %.37.i, i64 %.31.i
  store double 0.000000e+00, ptr %.41.i, align 8, !noalias !200
  br label %_ZN18biped_adrc_kernels3armB3v71B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a.exit

_ZN18biped_adrc_kernels3armB3v71B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a.exit:
  store i64 1, ptr %.45, align 8, !noalias !200
  br label %B116

B116:
  store ptr null, ptr %excinfo.1.i, align 8, !noalias !203
  %.8.i1 = getelementptr i8, ptr %arg.r, i64 344
  %.10.i2 = load double, ptr %.8.i1, align 8, !noalias !203
  %.12.i3 = getelementptr i8, ptr %arg.r, i64 368
  %.14.i = load double, ptr %.12.i3, align 8, !noalias !203
  %.15.i = fcmp olt double %.10.i2, %.14.i
  br i1 %.15.i, label %B36.i.preheader, label %_ZN18biped_adrc_kernels6travelB3v72B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a.exit.thread

B36.i.preheader:
  %sunkaddr30 = getelementptr i8, ptr %arg.r, i64 512
  br label %B36.i

B36.i:
  store double 0x7FF0000000000000, ptr %sunkaddr30, align 8, !noalias !203
  %.25.i4 = tail call i64 @due(ptr nonnull %arg.r), !noalias !203
  %.29.i = icmp eq i64 %.25.i4, 0
  br i1 %.29.i, label %B112.i, label %_ZN18biped_adrc_kernels6travelB3v72B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a.exit.thread

B112.i:
  store double 0.000000e+00, ptr %.33.i, align 8, !noalias !203
  %.37.i5 = call i32 @_ZN18biped_adrc_kernels10next_breakB3v73B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a(ptr nonnull %.33.i, ptr nonnull %excinfo.1.i, ptr nonnull %arg.r), !noalias !203
  %cond.i = icmp eq i32 %.37.i5, 0
  br i1 %cond.i, label %B170.i, label %_ZN18biped_adrc_kernels6travelB3v72B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a.exit, !prof !24

B170.i:
  %.47.i = load double, ptr %.33.i, align 8, !noalias !203
  %.60.i = tail call i64 @through(ptr nonnull %arg.r, double %.47.i), !noalias !203
  %.65.not.i = icmp eq i64 %.60.i, 0
  br i1 %.65.not.i, label %B186.i, label %_ZN18biped_adrc_kernels6travelB3v72B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a.exit.thread

B186.i:
  %.79.i = load double, ptr %.8.i1, align 8, !noalias !203
  %.83.i = load double, ptr %.12.i3, align 8, !noalias !203
  %.84.i = fcmp olt double %.79.i, %.83.i
  br i1 %.84.i, label %B36.i, label %_ZN18biped_adrc_kernels6travelB3v72B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a.exit.thread

_ZN18biped_adrc_kernels6travelB3v72B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a.exit.thread:
  %.78.0.ph = phi i64 [ 0, %B116 ], [ %.25.i4, %B36.i ], [ %.60.i, %B170.i ], [ 0, %B186.i ]
  %.107 = load i64, ptr %.8, align 8
  %.109 = icmp eq i64 %.107, %.9
  br i1 %.109, label %B168, label %B332

_ZN18biped_adrc_kernels6travelB3v72B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a.exit:
  %.38.i = load ptr, ptr %excinfo.1.i, align 8, !noalias !203
  %.90 = icmp sgt i32 %.37.i5, 0
  %.91 = select i1 %.90, ptr %.38.i, ptr undef
  store ptr %.91, ptr %excinfo, align 8
  br label %common.ret

B168:
  %.116 = load double, ptr %.8.i1, align 8
  %.118 = getelementptr i8, ptr %arg.r, i64 376
  %.120 = load double, ptr %.118, align 8
  %.121 = fcmp oeq double %.116, %.120
  br i1 %.121, label %B200.endif, label %B332

B242:
  %.2114749 = phi i64 [ 0, %B242.lr.ph.new ], [ %.218.7, %B242 ]
  %.245 = load i64, ptr %sunkaddr35, align 8
  %.246 = inttoptr i64 %.245 to ptr
  %0 = shl i64 %.2114749, 3
  %scevgep28 = getelementptr i8, ptr %.246, i64 %0
  store double 0.000000e+00, ptr %scevgep28, align 8
  %.245.1 = load i64, ptr %sunkaddr35, align 8
  %.246.1 = inttoptr i64 %.245.1 to ptr
  %scevgep26 = getelementptr i8, ptr %.246.1, i64 8
  %scevgep27 = getelementptr i8, ptr %scevgep26, i64 %0
  store double 0.000000e+00, ptr %scevgep27, align 8
  %.245.2 = load i64, ptr %sunkaddr35, align 8
  %.246.2 = inttoptr i64 %.245.2 to ptr
  %scevgep24 = getelementptr i8, ptr %.246.2, i64 16
  %scevgep25 = getelementptr i8, ptr %scevgep24, i64 %0
  store double 0.000000e+00, ptr %scevgep25, align 8
  %.245.3 = load i64, ptr %sunkaddr35, align 8
  %.246.3 = inttoptr i64 %.245.3 to ptr
  %scevgep22 = getelementptr i8, ptr %.246.3, i64 24
  %scevgep23 = getelementptr i8, ptr %scevgep22, i64 %0
  store double 0.000000e+00, ptr %scevgep23, align 8
  %.245.4 = load i64, ptr %sunkaddr35, align 8
  %.246.4 = inttoptr i64 %.245.4 to ptr
  %scevgep20 = getelementptr i8, ptr %.246.4, i64 32
  %scevgep21 = getelementptr i8, ptr %scevgep20, i64 %0
  store double 0.000000e+00, ptr %scevgep21, align 8
  %.245.5 = load i64, ptr %sunkaddr35, align 8
  %.246.5 = inttoptr i64 %.245.5 to ptr
  %scevgep18 = getelementptr i8, ptr %.246.5, i64 40
  %scevgep19 = getelementptr i8, ptr %scevgep18, i64 %0
  store double 0.000000e+00, ptr %scevgep19, align 8
  %.245.6 = load i64, ptr %sunkaddr35, align 8
  %.246.6 = inttoptr i64 %.245.6 to ptr
  %scevgep16 = getelementptr i8, ptr %.246.6, i64 48
  %scevgep17 = getelementptr i8, ptr %scevgep16, i64 %0
  store double 0.000000e+00, ptr %scevgep17, align 8
  %.218.7 = add nuw nsw i64 %.2114749, 8
  %.245.7 = load i64, ptr %sunkaddr35, align 8
  %.246.7 = inttoptr i64 %.245.7 to ptr
  %scevgep14 = getelementptr i8, ptr %.246.7, i64 56
  %scevgep15 = getelementptr i8, ptr %scevgep14, i64 %0
  store double 0.000000e+00, ptr %scevgep15, align 8
  %niter.ncmp.7 = icmp eq i64 %unroll_iter, %.218.7
  br i1 %niter.ncmp.7, label %B266.loopexit.unr-lcssa, label %B242

B266.loopexit.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B266.loopexit, label %B242.epil.preheader

B242.epil.preheader:
  %.2114749.epil.init = phi i64 [ 0, %B242.lr.ph ], [ %unroll_iter, %B266.loopexit.unr-lcssa ]
  %sunkaddr36 = getelementptr i8, ptr %arg.r, i64 704
  br label %B242.epil

B242.epil:
  %lsr.iv = phi i64 [ %lsr.iv.next, %B242.epil ], [ %xtraiter, %B242.epil.preheader ]
  %.2114749.epil = phi i64 [ %.218.epil, %B242.epil ], [ %.2114749.epil.init, %B242.epil.preheader ]
  %.218.epil = add nuw nsw i64 %.2114749.epil, 1
  %.245.epil = load i64, ptr %sunkaddr36, align 8
  %.246.epil = inttoptr i64 %.245.epil to ptr
  %1 = shl i64 %.2114749.epil, 3
  %scevgep = getelementptr i8, ptr %.246.epil, i64 %1
  store double 0.000000e+00, ptr %scevgep, align 8
  %lsr.iv.next = add nsw i64 %lsr.iv, -1
  %epil.iter.cmp.not = icmp eq i64 %lsr.iv.next, 0
  br i1 %epil.iter.cmp.not, label %B266.loopexit, label %B242.epil, !llvm.loop !207

B266.loopexit:
  %.258.pre = load double, ptr %.8.i1, align 8
  br label %B266

B266:
  %.258 = phi double [ %.258.pre, %B266.loopexit ], [ %.116, %B200.endif ]
  %.260 = getelementptr i8, ptr %arg.r, i64 696
  %.261 = load i64, ptr %.260, align 8
  %.264 = getelementptr i8, ptr %arg.r, i64 704
  %.265 = load i64, ptr %.264, align 8
  %.17.i = getelementptr i8, ptr %arg.r, i64 400
  %.18.i = load i64, ptr %.17.i, align 8, !noalias !208
  %.19.i = icmp sgt i64 %.18.i, 0
  br i1 %.19.i, label %B48.i, label %B26.i

B26.i:
  %.22.i7 = getelementptr i8, ptr %arg.r, i64 64
  %.23.i = load i64, ptr %.22.i7, align 8, !noalias !208
  %.24.not.i = icmp eq i64 %.23.i, 0
  br i1 %.24.not.i, label %B332, label %B48.i

B48.i:
  %2 = inttoptr i64 %.265 to ptr
  %3 = inttoptr i64 %.261 to ptr
  %.30.i8 = tail call ptr @node(ptr nonnull %arg.r, double %.258, ptr %3, ptr %2), !noalias !208
  br label %B332

common.ret:
  %common.ret.op = phi i32 [ 0, %B332 ], [ %.22, %B0.if.if ], [ %.37.i5, %_ZN18biped_adrc_kernels6travelB3v72B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a.exit ]
  ret i32 %common.ret.op

B332:
  store i64 %.78.0.ph, ptr %retptr, align 8
  br label %common.ret

B0.endif:
  %.45 = getelementptr i8, ptr %arg.r, i64 392
  %.46 = load i64, ptr %.45, align 8
  %.47 = icmp eq i64 %.46, 0
  br i1 %.47, label %B86, label %B116

B0.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B200.endif:
  %.124 = getelementptr i8, ptr %arg.r, i64 80
  %.125 = load i64, ptr %.124, align 8
  %.20548.not = icmp slt i64 %.125, 1
  br i1 %.20548.not, label %B266, label %B242.lr.ph

B242.lr.ph:
  %xtraiter = and i64 %.125, 7
  %4 = icmp samesign ult i64 %.125, 8
  br i1 %4, label %B242.epil.preheader, label %B242.lr.ph.new

B242.lr.ph.new:
  %unroll_iter = and i64 %.125, 9223372036854775800
  %sunkaddr35 = getelementptr i8, ptr %arg.r, i64 704
  br label %B242
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels5lowerB3v70B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr initializes((504, 512)) %arg.r) local_unnamed_addr #0 {
B0.endif:
  %.8 = getelementptr i8, ptr %arg.r, i64 504
  store double 0.000000e+00, ptr %.8, align 8
  %.12 = getelementptr i8, ptr %arg.r, i64 184
  %.13 = load i64, ptr %.12, align 8
  %.9544.not = icmp slt i64 %.13, 1
  br i1 %.9544.not, label %B180, label %B60.lr.ph

B60.lr.ph:
  %.137 = getelementptr i8, ptr %arg.r, i64 280
  %.138 = load i64, ptr %.137, align 8
  %.145 = getelementptr i8, ptr %arg.r, i64 352
  %.147 = load double, ptr %.145, align 8
  %xtraiter = and i64 %.13, 7
  %0 = icmp samesign ult i64 %.13, 8
  %.pre = inttoptr i64 %.138 to ptr
  br i1 %0, label %B60.epil.preheader, label %B60.lr.ph.new

B60.lr.ph.new:
  %unroll_iter = and i64 %.13, 9223372036854775800
  %scevgep5 = getelementptr i8, ptr %.pre, i64 120
  br label %B60

B60:
  %lsr.iv1 = phi i64 [ %lsr.iv.next2, %B178.7 ], [ %unroll_iter, %B60.lr.ph.new ]
  %lsr.iv6 = phi ptr [ %scevgep7, %B178.7 ], [ %scevgep5, %B60.lr.ph.new ]
  %.153 = phi double [ %.15349.7, %B178.7 ], [ 0.000000e+00, %B60.lr.ph.new ]
  %scevgep21 = getelementptr i8, ptr %lsr.iv6, i64 -120
  %.143 = load double, ptr %scevgep21, align 8
  %.148 = fcmp oeq double %.143, %.147
  br i1 %.148, label %B112, label %B178

B112:
  %scevgep22 = getelementptr i8, ptr %lsr.iv6, i64 -112
  %.164 = load double, ptr %scevgep22, align 8
  %.165 = fadd double %.153, %.164
  store double %.165, ptr %.8, align 8
  br label %B178

B178:
  %.15349 = phi double [ %.165, %B112 ], [ %.153, %B60 ]
  %scevgep20 = getelementptr i8, ptr %lsr.iv6, i64 -104
  %.143.1 = load double, ptr %scevgep20, align 8
  %.148.1 = fcmp oeq double %.143.1, %.147
  br i1 %.148.1, label %B112.1, label %B178.1

B112.1:
  %scevgep19 = getelementptr i8, ptr %lsr.iv6, i64 -96
  %.164.1 = load double, ptr %scevgep19, align 8
  %.165.1 = fadd double %.15349, %.164.1
  store double %.165.1, ptr %.8, align 8
  br label %B178.1

B178.1:
  %.15349.1 = phi double [ %.165.1, %B112.1 ], [ %.15349, %B178 ]
  %scevgep18 = getelementptr i8, ptr %lsr.iv6, i64 -88
  %.143.2 = load double, ptr %scevgep18, align 8
  %.148.2 = fcmp oeq double %.143.2, %.147
  br i1 %.148.2, label %B112.2, label %B178.2

B112.2:
  %scevgep17 = getelementptr i8, ptr %lsr.iv6, i64 -80
  %.164.2 = load double, ptr %scevgep17, align 8
  %.165.2 = fadd double %.15349.1, %.164.2
  store double %.165.2, ptr %.8, align 8
  br label %B178.2

B178.2:
  %.15349.2 = phi double [ %.165.2, %B112.2 ], [ %.15349.1, %B178.1 ]
  %scevgep16 = getelementptr i8, ptr %lsr.iv6, i64 -72
  %.143.3 = load double, ptr %scevgep16, align 8
  %.148.3 = fcmp oeq double %.143.3, %.147
  br i1 %.148.3, label %B112.3, label %B178.3

B112.3:
  %scevgep15 = getelementptr i8, ptr %lsr.iv6, i64 -64
  %.164.3 = load double, ptr %scevgep15, align 8
  %.165.3 = fadd double %.15349.2, %.164.3
  store double %.165.3, ptr %.8, align 8
  br label %B178.3

B178.3:
  %.15349.3 = phi double [ %.165.3, %B112.3 ], [ %.15349.2, %B178.2 ]
  %scevgep14 = getelementptr i8, ptr %lsr.iv6, i64 -56
  %.143.4 = load double, ptr %scevgep14, align 8
  %.148.4 = fcmp oeq double %.143.4, %.147
  br i1 %.148.4, label %B112.4, label %B178.4

B112.4:
  %scevgep13 = getelementptr i8, ptr %lsr.iv6, i64 -48
  %.164.4 = load double, ptr %scevgep13, align 8
  %.165.4 = fadd double %.15349.3, %.164.4
  store double %.165.4, ptr %.8, align 8
  br label %B178.4

B178.4:
  %.15349.4 = phi double [ %.165.4, %B112.4 ], [ %.15349.3, %B178.3 ]
  %scevgep12 = getelementptr i8, ptr %lsr.iv6, i64 -40
  %.143.5 = load double, ptr %scevgep12, align 8
  %.148.5 = fcmp oeq double %.143.5, %.147
  br i1 %.148.5, label %B112.5, label %B178.5

B112.5:
  %scevgep11 = getelementptr i8, ptr %lsr.iv6, i64 -32
  %.164.5 = load double, ptr %scevgep11, align 8
  %.165.5 = fadd double %.15349.4, %.164.5
  store double %.165.5, ptr %.8, align 8
  br label %B178.5

B178.5:
  %.15349.5 = phi double [ %.165.5, %B112.5 ], [ %.15349.4, %B178.4 ]
  %scevgep10 = getelementptr i8, ptr %lsr.iv6, i64 -24
  %.143.6 = load double, ptr %scevgep10, align 8
  %.148.6 = fcmp oeq double %.143.6, %.147
  br i1 %.148.6, label %B112.6, label %B178.6

B112.6:
  %scevgep9 = getelementptr i8, ptr %lsr.iv6, i64 -16
  %.164.6 = load double, ptr %scevgep9, align 8
  %.165.6 = fadd double %.15349.5, %.164.6
  store double %.165.6, ptr %.8, align 8
  br label %B178.6

B178.6:
  %.15349.6 = phi double [ %.165.6, %B112.6 ], [ %.15349.5, %B178.5 ]
  %scevgep8 = getelementptr i8, ptr %lsr.iv6, i64 -8
  %.143.7 = load double, ptr %scevgep8, align 8
  %.148.7 = fcmp oeq double %.143.7, %.147
  br i1 %.148.7, label %B112.7, label %B178.7

B112.7:
  %.164.7 = load double, ptr %lsr.iv6, align 8
  %.165.7 = fadd double %.15349.6, %.164.7
  store double %.165.7, ptr %.8, align 8
  br label %B178.7

B178.7:
  %.15349.7 = phi double [ %.165.7, %B112.7 ], [ %.15349.6, %B178.6 ]
  %scevgep7 = getelementptr i8, ptr %lsr.iv6, i64 128
  %lsr.iv.next2 = add nsw i64 %lsr.iv1, -8
  %niter.ncmp.7 = icmp eq i64 %lsr.iv.next2, 0
  br i1 %niter.ncmp.7, label %B180.loopexit.unr-lcssa, label %B60

B180.loopexit.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B180, label %B60.epil.preheader

B60.epil.preheader:
  %.153.epil.init = phi double [ %.15349.7, %B180.loopexit.unr-lcssa ], [ 0.000000e+00, %B60.lr.ph ]
  %.1014345.epil.init = phi i64 [ %unroll_iter, %B180.loopexit.unr-lcssa ], [ 0, %B60.lr.ph ]
  %1 = shl i64 %.1014345.epil.init, 4
  %2 = getelementptr i8, ptr %.pre, i64 %1
  %scevgep = getelementptr i8, ptr %2, i64 8
  %3 = shl nuw nsw i64 %xtraiter, 4
  br label %B60.epil

B60.epil:
  %lsr.iv = phi i64 [ %lsr.iv.next, %B178.epil ], [ 0, %B60.epil.preheader ]
  %.153.epil = phi double [ %.15349.epil, %B178.epil ], [ %.153.epil.init, %B60.epil.preheader ]
  %scevgep3 = getelementptr i8, ptr %scevgep, i64 %lsr.iv
  %scevgep4 = getelementptr i8, ptr %scevgep3, i64 -8
  %.143.epil = load double, ptr %scevgep4, align 8
  %.148.epil = fcmp oeq double %.143.epil, %.147
  br i1 %.148.epil, label %B112.epil, label %B178.epil

B112.epil:
  %.164.epil = load double, ptr %scevgep3, align 8
  %.165.epil = fadd double %.153.epil, %.164.epil
  store double %.165.epil, ptr %.8, align 8
  br label %B178.epil

B178.epil:
  %.15349.epil = phi double [ %.165.epil, %B112.epil ], [ %.153.epil, %B60.epil ]
  %lsr.iv.next = add nuw nsw i64 %lsr.iv, 16
  %epil.iter.cmp.not = icmp eq i64 %3, %lsr.iv.next
  br i1 %epil.iter.cmp.not, label %B180, label %B60.epil, !llvm.loop !211

B180:
  store ptr null, ptr %retptr, align 8
  ret i32 0
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels10next_breakB3v73B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr readonly %arg.r) local_unnamed_addr #0 {
B0:
  %.17 = alloca double, align 8
  %excinfo.1 = alloca ptr, align 8
  %.9 = getelementptr i8, ptr %arg.r, i64 344
  %.11 = load double, ptr %.9, align 8
  %.13 = getelementptr i8, ptr %arg.r, i64 368
  %.15 = load double, ptr %.13, align 8
  store double 0.000000e+00, ptr %.17, align 8
  %.21 = call i32 @_ZN18biped_adrc_kernels11next_switchB3v74B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add(ptr nonnull %.17, ptr nonnull %excinfo.1, ptr %arg.r, double %.11, double %.15)
  %.31 = load double, ptr %.17, align 8
  switch i32 %.21, label %B0.if.if [
    i32 -2, label %B0.endif
    i32 0, label %B0.endif
  ], !prof !8

B188:
  %first.3.0 = phi double [ %.31, %B0.endif ], [ %.13.i, %B80.endif.endif ]
  %.156 = getelementptr i8, ptr %arg.r, i64 224
  %.158 = load double, ptr %.156, align 8
  %.159 = fcmp ogt double %.158, 0.000000e+00
  br i1 %.159, label %B210.endif, label %B334

common.ret:
  %common.ret.op = phi i32 [ 0, %B334 ], [ %.21, %B0.if.if ]
  ret i32 %common.ret.op

B334:
  %first.4.0 = phi double [ %first.3.0, %B188 ], [ %.13.i26, %B210.endif.endif ]
  store double %first.4.0, ptr %retptr, align 8
  br label %common.ret

B0.endif:
  %.51 = getelementptr i8, ptr %arg.r, i64 216
  %.53 = load double, ptr %.51, align 8
  %.54 = fcmp ogt double %.53, 0.000000e+00
  br i1 %.54, label %B80.endif, label %B188

B0.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B80.endif:
  %.8.i = getelementptr i8, ptr %arg.r, i64 152
  %.9.i = load i64, ptr %.8.i, align 8, !noalias !212
  %.10.i = icmp eq i64 %.9.i, 1
  %"$phi52.0.2.0.in.v.i" = select i1 %.10.i, i64 376, i64 232
  %"$phi52.0.2.0.in.i" = getelementptr i8, ptr %arg.r, i64 %"$phi52.0.2.0.in.v.i"
  %"$phi52.0.2.0.i" = load double, ptr %"$phi52.0.2.0.in.i", align 8, !noalias !212
  %.15.i = fsub double %.11, %"$phi52.0.2.0.i"
  %.20.i = fdiv double %.15.i, %.53
  %.21.i = tail call double @llvm.floor.f64(double %.20.i)
  %.22.i = fptosi double %.21.i to i64
  %.13.i.i = tail call i64 @llvm.smax.i64(i64 %.22.i, i64 0)
  %.60.i = uitofp nneg i64 %.13.i.i to double
  %.61.i = fmul double %.53, %.60.i
  %.63.i = fadd double %"$phi52.0.2.0.i", %.61.i
  %.65.i = fcmp ugt double %.63.i, %.11
  br i1 %.65.i, label %B80.endif.endif, label %B108.i

B108.i:
  %lsr.iv3.in = phi i64 [ %lsr.iv3, %B108.i ], [ %.13.i.i, %B80.endif ]
  %lsr.iv3 = add i64 %lsr.iv3.in, 1
  %.74.i = uitofp nneg i64 %lsr.iv3 to double
  %.75.i = fmul double %.53, %.74.i
  %.77.i = fadd double %"$phi52.0.2.0.i", %.75.i
  %.79.i = fcmp ugt double %.77.i, %.11
  br i1 %.79.i, label %B80.endif.endif, label %B108.i

B80.endif.endif:
  %.94.pre-phi.i = phi double [ %.63.i, %B80.endif ], [ %.77.i, %B108.i ]
  %.12.i = fcmp olt double %.94.pre-phi.i, %.31
  %.13.i = select i1 %.12.i, double %.94.pre-phi.i, double %.31
  br label %B188

B210.endif:
  %.8.i1 = getelementptr i8, ptr %arg.r, i64 152
  %.9.i2 = load i64, ptr %.8.i1, align 8, !noalias !215
  %.10.i3 = icmp eq i64 %.9.i2, 1
  %"$phi52.0.2.0.in.v.i4" = select i1 %.10.i3, i64 376, i64 232
  %"$phi52.0.2.0.in.i5" = getelementptr i8, ptr %arg.r, i64 %"$phi52.0.2.0.in.v.i4"
  %"$phi52.0.2.0.i6" = load double, ptr %"$phi52.0.2.0.in.i5", align 8, !noalias !215
  %.196 = fadd double %.158, %"$phi52.0.2.0.i6"
  %.15.i7 = fsub double %.11, %.196
  %.20.i8 = fdiv double %.15.i7, %.53
  %.21.i9 = tail call double @llvm.floor.f64(double %.20.i8)
  %.22.i10 = fptosi double %.21.i9 to i64
  %.13.i.i11 = tail call i64 @llvm.smax.i64(i64 %.22.i10, i64 0)
  %.60.i12 = uitofp nneg i64 %.13.i.i11 to double
  %.61.i13 = fmul double %.53, %.60.i12
  %.63.i14 = fadd double %.196, %.61.i13
  %.65.i15 = fcmp ugt double %.63.i14, %.11
  br i1 %.65.i15, label %B210.endif.endif, label %B108.i16

B108.i16:
  %lsr.iv2.in = phi i64 [ %lsr.iv2, %B108.i16 ], [ %.13.i.i11, %B210.endif ]
  %lsr.iv2 = add i64 %lsr.iv2.in, 1
  %.74.i19 = uitofp nneg i64 %lsr.iv2 to double
  %.75.i20 = fmul double %.53, %.74.i19
  %.77.i21 = fadd double %.196, %.75.i20
  %.79.i22 = fcmp ugt double %.77.i21, %.11
  br i1 %.79.i22, label %B210.endif.endif, label %B108.i16

B210.endif.endif:
  %.94.pre-phi.i23 = phi double [ %.63.i14, %B210.endif ], [ %.77.i21, %B108.i16 ]
  %.12.i25 = fcmp olt double %.94.pre-phi.i23, %first.3.0
  %.13.i26 = select i1 %.12.i25, double %.94.pre-phi.i23, double %first.3.0
  br label %B334
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels11next_switchB3v74B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.r, double %arg.t, double %arg.last) local_unnamed_addr #0 {
B0.endif:
  %.15 = getelementptr i8, ptr %arg.r, i64 192
  %.16 = load i64, ptr %.15, align 8
  %.9845.not = icmp slt i64 %.16, 1
  br i1 %.9845.not, label %B236, label %B50.lr.ph

B50.lr.ph:
  %.137 = getelementptr i8, ptr %arg.r, i64 288
  %.138 = load i64, ptr %.137, align 8
  %.162 = getelementptr i8, ptr %arg.r, i64 352
  %.164 = load double, ptr %.162, align 8
  %xtraiter = and i64 %.16, 3
  %0 = icmp samesign ult i64 %.16, 4
  %.pre = inttoptr i64 %.138 to ptr
  br i1 %0, label %B50.epil.preheader, label %B50.lr.ph.new

B50.lr.ph.new:
  %scevgep6 = getelementptr i8, ptr %.pre, i64 56
  %1 = and i64 %.16, 9223372036854775804
  %sunkaddr3 = getelementptr i8, ptr %arg.r, i64 360
  br label %B50

B50:
  %lsr.iv1 = phi i64 [ %lsr.iv.next2, %B237.3 ], [ %1, %B50.lr.ph.new ]
  %lsr.iv7 = phi ptr [ %scevgep8, %B237.3 ], [ %scevgep6, %B50.lr.ph.new ]
  %first.2.048 = phi double [ %first.3.1.3, %B237.3 ], [ %arg.last, %B50.lr.ph.new ]
  %scevgep14 = getelementptr i8, ptr %lsr.iv7, i64 -56
  %.142 = load double, ptr %scevgep14, align 8
  %scevgep15 = getelementptr i8, ptr %lsr.iv7, i64 -48
  %.150 = load double, ptr %scevgep15, align 8
  %.166 = fcmp oeq double %.142, %.164
  br i1 %.166, label %B164, label %B164.thread

B164:
  %.171 = load double, ptr %sunkaddr3, align 8
  %.173 = fadd double %.150, %.171
  br label %B198

B164.thread:
  %.18235 = fcmp oeq double %.142, 0.000000e+00
  br i1 %.18235, label %B198, label %B237

B198:
  %s.2.137 = phi double [ %.150, %B164.thread ], [ %.173, %B164 ]
  %.203 = fcmp olt double %arg.t, %s.2.137
  %.214 = fcmp olt double %s.2.137, %first.2.048
  %or.cond = select i1 %.203, i1 %.214, i1 false
  %spec.select = select i1 %or.cond, double %s.2.137, double %first.2.048
  br label %B237

B236.loopexit.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B236, label %B50.epil.preheader

B50.epil.preheader:
  %first.2.048.epil.init = phi double [ %first.3.1.3, %B236.loopexit.unr-lcssa ], [ %arg.last, %B50.lr.ph ]
  %.1044446.epil.init = phi i64 [ %1, %B236.loopexit.unr-lcssa ], [ 0, %B50.lr.ph ]
  %2 = shl i64 %.1044446.epil.init, 4
  %3 = getelementptr i8, ptr %.pre, i64 %2
  %scevgep = getelementptr i8, ptr %3, i64 8
  %4 = shl nuw nsw i64 %xtraiter, 4
  %sunkaddr4 = getelementptr i8, ptr %arg.r, i64 360
  br label %B50.epil

B50.epil:
  %lsr.iv = phi i64 [ %lsr.iv.next, %B237.epil ], [ 0, %B50.epil.preheader ]
  %first.2.048.epil = phi double [ %first.3.1.epil, %B237.epil ], [ %first.2.048.epil.init, %B50.epil.preheader ]
  %scevgep4 = getelementptr i8, ptr %scevgep, i64 %lsr.iv
  %scevgep5 = getelementptr i8, ptr %scevgep4, i64 -8
  %.142.epil = load double, ptr %scevgep5, align 8
  %.150.epil = load double, ptr %scevgep4, align 8
  %.166.epil = fcmp oeq double %.142.epil, %.164
  br i1 %.166.epil, label %B164.epil, label %B164.thread.epil

B164.thread.epil:
  %.18235.epil = fcmp oeq double %.142.epil, 0.000000e+00
  br i1 %.18235.epil, label %B198.epil, label %B237.epil

B164.epil:
  %.171.epil = load double, ptr %sunkaddr4, align 8
  %.173.epil = fadd double %.150.epil, %.171.epil
  br label %B198.epil

B198.epil:
  %s.2.137.epil = phi double [ %.150.epil, %B164.thread.epil ], [ %.173.epil, %B164.epil ]
  %.203.epil = fcmp olt double %arg.t, %s.2.137.epil
  %.214.epil = fcmp olt double %s.2.137.epil, %first.2.048.epil
  %or.cond.epil = select i1 %.203.epil, i1 %.214.epil, i1 false
  %spec.select.epil = select i1 %or.cond.epil, double %s.2.137.epil, double %first.2.048.epil
  br label %B237.epil

B237.epil:
  %first.3.1.epil = phi double [ %spec.select.epil, %B198.epil ], [ %first.2.048.epil, %B164.thread.epil ]
  %lsr.iv.next = add nuw nsw i64 %lsr.iv, 16
  %epil.iter.cmp.not = icmp eq i64 %4, %lsr.iv.next
  br i1 %epil.iter.cmp.not, label %B236, label %B50.epil, !llvm.loop !218

B236:
  %first.2.0.lcssa = phi double [ %arg.last, %B0.endif ], [ %first.3.1.3, %B236.loopexit.unr-lcssa ], [ %first.3.1.epil, %B237.epil ]
  store double %first.2.0.lcssa, ptr %retptr, align 8
  ret i32 0

B237:
  %first.3.1 = phi double [ %spec.select, %B198 ], [ %first.2.048, %B164.thread ]
  %scevgep13 = getelementptr i8, ptr %lsr.iv7, i64 -40
  %.142.1 = load double, ptr %scevgep13, align 8
  %scevgep12 = getelementptr i8, ptr %lsr.iv7, i64 -32
  %.150.1 = load double, ptr %scevgep12, align 8
  %.166.1 = fcmp oeq double %.142.1, %.164
  br i1 %.166.1, label %B164.1, label %B164.thread.1

B164.thread.1:
  %.18235.1 = fcmp oeq double %.142.1, 0.000000e+00
  br i1 %.18235.1, label %B198.1, label %B237.1

B164.1:
  %.171.1 = load double, ptr %sunkaddr3, align 8
  %.173.1 = fadd double %.150.1, %.171.1
  br label %B198.1

B198.1:
  %s.2.137.1 = phi double [ %.150.1, %B164.thread.1 ], [ %.173.1, %B164.1 ]
  %.203.1 = fcmp olt double %arg.t, %s.2.137.1
  %.214.1 = fcmp olt double %s.2.137.1, %first.3.1
  %or.cond.1 = select i1 %.203.1, i1 %.214.1, i1 false
  %spec.select.1 = select i1 %or.cond.1, double %s.2.137.1, double %first.3.1
  br label %B237.1

B237.1:
  %first.3.1.1 = phi double [ %spec.select.1, %B198.1 ], [ %first.3.1, %B164.thread.1 ]
  %scevgep11 = getelementptr i8, ptr %lsr.iv7, i64 -24
  %.142.2 = load double, ptr %scevgep11, align 8
  %scevgep10 = getelementptr i8, ptr %lsr.iv7, i64 -16
  %.150.2 = load double, ptr %scevgep10, align 8
  %.166.2 = fcmp oeq double %.142.2, %.164
  br i1 %.166.2, label %B164.2, label %B164.thread.2

B164.thread.2:
  %.18235.2 = fcmp oeq double %.142.2, 0.000000e+00
  br i1 %.18235.2, label %B198.2, label %B237.2

B164.2:
  %.171.2 = load double, ptr %sunkaddr3, align 8
  %.173.2 = fadd double %.150.2, %.171.2
  br label %B198.2

B198.2:
  %s.2.137.2 = phi double [ %.150.2, %B164.thread.2 ], [ %.173.2, %B164.2 ]
  %.203.2 = fcmp olt double %arg.t, %s.2.137.2
  %.214.2 = fcmp olt double %s.2.137.2, %first.3.1.1
  %or.cond.2 = select i1 %.203.2, i1 %.214.2, i1 false
  %spec.select.2 = select i1 %or.cond.2, double %s.2.137.2, double %first.3.1.1
  br label %B237.2

B237.2:
  %first.3.1.2 = phi double [ %spec.select.2, %B198.2 ], [ %first.3.1.1, %B164.thread.2 ]
  %scevgep9 = getelementptr i8, ptr %lsr.iv7, i64 -8
  %.142.3 = load double, ptr %scevgep9, align 8
  %.150.3 = load double, ptr %lsr.iv7, align 8
  %.166.3 = fcmp oeq double %.142.3, %.164
  br i1 %.166.3, label %B164.3, label %B164.thread.3

B164.thread.3:
  %.18235.3 = fcmp oeq double %.142.3, 0.000000e+00
  br i1 %.18235.3, label %B198.3, label %B237.3

B164.3:
  %.171.3 = load double, ptr %sunkaddr3, align 8
  %.173.3 = fadd double %.150.3, %.171.3
  br label %B198.3

B198.3:
  %s.2.137.3 = phi double [ %.150.3, %B164.thread.3 ], [ %.173.3, %B164.3 ]
  %.203.3 = fcmp olt double %arg.t, %s.2.137.3
  %.214.3 = fcmp olt double %s.2.137.3, %first.3.1.2
  %or.cond.3 = select i1 %.203.3, i1 %.214.3, i1 false
  %spec.select.3 = select i1 %or.cond.3, double %s.2.137.3, double %first.3.1.2
  br label %B237.3

B237.3:
  %first.3.1.3 = phi double [ %spec.select.3, %B198.3 ], [ %first.3.1.2, %B164.thread.3 ]
  %scevgep8 = getelementptr i8, ptr %lsr.iv7, i64 64
  %lsr.iv.next2 = add nsw i64 %lsr.iv1, -4
  %niter.ncmp.3 = icmp eq i64 %lsr.iv.next2, 0
  br i1 %niter.ncmp.3, label %B236.loopexit.unr-lcssa, label %B50
}


define i64 @go_on(ptr initializes((496, 512)) %.1) local_unnamed_addr #0 {
entry:
  %.3 = alloca i64, align 8
  store i64 0, ptr %.3, align 8
  %excinfo = alloca ptr, align 8
  %.7 = call i32 @_ZN18biped_adrc_kernels5go_onB3v69B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3, ptr nonnull %excinfo, ptr %.1) #0
  %cond = icmp eq i32 %.7, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.17 = load i64, ptr %.3, align 8
  ret i64 %.17
}

define i32 @_ZN18biped_adrc_kernels4landB3v76B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r) local_unnamed_addr {
B0:
  %.41 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.163 = alloca ptr, align 8
  %excinfo.3 = alloca ptr, align 8
  %.8 = getelementptr i8, ptr %arg.r, i64 344
  %.10 = load double, ptr %.8, align 8
  %.12 = getelementptr i8, ptr %arg.r, i64 352
  %.14 = load double, ptr %.12, align 8
  %.15 = fadd double %.14, 1.000000e+00
  %.17 = getelementptr i8, ptr %arg.r, i64 640
  %.18 = load i64, ptr %.17, align 8
  %.19 = inttoptr i64 %.18 to ptr
  store double %.10, ptr %.19, align 8
  %.24 = load i64, ptr %.17, align 8
  %.25 = inttoptr i64 %.24 to ptr
  %.26 = getelementptr i8, ptr %.25, i64 8
  store double %.15, ptr %.26, align 8
  %.30 = getelementptr i8, ptr %arg.r, i64 696
  %.31 = load i64, ptr %.30, align 8
  %.32 = inttoptr i64 %.31 to ptr
  %.35 = load i64, ptr %.17, align 8
  %.36 = inttoptr i64 %.35 to ptr
  %.37 = getelementptr i8, ptr %.36, i64 16
  %.39 = getelementptr i8, ptr %arg.r, i64 80
  %.40 = load i64, ptr %.39, align 8
  %.45 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.41, ptr nonnull %excinfo.1, ptr %.32, ptr %.37, i64 %.40)
  switch i32 %.45, label %B0.if.if [
    i32 -2, label %B0.endif
    i32 0, label %B0.endif
  ], !prof !8

common.ret:
  %common.ret.op = phi i32 [ 0, %B324 ], [ 0, %B390 ], [ %.45, %B0.if.if ], [ %.167, %B404.if.if ], [ 0, %B404.endif ]
  ret i32 %common.ret.op

B324:
  store i64 5, ptr %retptr, align 8
  br label %common.ret

B338:
  %.9240.not.i = icmp slt i64 %.96, 1
  br i1 %.9240.not.i, label %B404, label %iter.check.i

iter.check.i:
  %min.iters.check.i = icmp samesign ult i64 %.96, 4
  br i1 %min.iters.check.i, label %B40.i.preheader, label %vector.main.loop.iter.check.i

vector.main.loop.iter.check.i:
  %min.iters.check1.i = icmp samesign ult i64 %.96, 16
  br i1 %min.iters.check1.i, label %vec.epilog.ph.i, label %vector.ph.i

vector.ph.i:
  %n.vec.i = and i64 %.96, 9223372036854775792
  br label %vector.body.i

vector.body.i:
  %index.i = phi i64 [ 0, %vector.ph.i ], [ %index.next.i, %vector.body.i ]
  %vec.phi.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %8, %vector.body.i ]
  %vec.phi2.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %9, %vector.body.i ]
  %vec.phi3.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %10, %vector.body.i ]
  %vec.phi4.i = phi <4 x i1> [ splat (i1 true), %vector.ph.i ], [ %11, %vector.body.i ]
  %sunkaddr = shl i64 %index.i, 3
  %sunkaddr34 = getelementptr i8, ptr %.93, i64 %sunkaddr
  %wide.load.i = load <4 x double>, ptr %sunkaddr34, align 8, !noalias !219
  %sunkaddr37 = getelementptr i8, ptr %sunkaddr34, i64 32
  %wide.load5.i = load <4 x double>, ptr %sunkaddr37, align 8, !noalias !219
  %sunkaddr40 = getelementptr i8, ptr %sunkaddr34, i64 64
  %wide.load6.i = load <4 x double>, ptr %sunkaddr40, align 8, !noalias !219
  %sunkaddr43 = getelementptr i8, ptr %sunkaddr34, i64 96
  %wide.load7.i = load <4 x double>, ptr %sunkaddr43, align 8, !noalias !219
  %0 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load.i)
  %1 = fcmp one <4 x double> %0, splat (double 0x7FF0000000000000)
  %2 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load5.i)
  %3 = fcmp one <4 x double> %2, splat (double 0x7FF0000000000000)
  %4 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load6.i)
  %5 = fcmp one <4 x double> %4, splat (double 0x7FF0000000000000)
  %6 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load7.i)
  %7 = fcmp one <4 x double> %6, splat (double 0x7FF0000000000000)
  %8 = and <4 x i1> %vec.phi.i, %1
  %9 = and <4 x i1> %vec.phi2.i, %3
  %10 = and <4 x i1> %vec.phi3.i, %5
  %11 = and <4 x i1> %vec.phi4.i, %7
  %index.next.i = add nuw nsw i64 %index.i, 16
  %12 = icmp eq i64 %n.vec.i, %index.next.i
  br i1 %12, label %middle.block.i, label %vector.body.i, !llvm.loop !222

middle.block.i:
  %bin.rdx.i = and <4 x i1> %8, %9
  %bin.rdx8.i = and <4 x i1> %10, %bin.rdx.i
  %bin.rdx9.i = and <4 x i1> %11, %bin.rdx8.i
  %13 = bitcast <4 x i1> %bin.rdx9.i to i4
  %14 = icmp eq i4 %13, -1
  %cmp.n.i = icmp eq i64 %.96, %n.vec.i
  br i1 %cmp.n.i, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit, label %vec.epilog.iter.check.i

vec.epilog.iter.check.i:
  %15 = and i64 %.96, 12
  %min.epilog.iters.check.i = icmp eq i64 %15, 0
  br i1 %min.epilog.iters.check.i, label %B40.i.preheader, label %vec.epilog.ph.i, !prof !20

vec.epilog.ph.i:
  %vec.epilog.resume.val.i = phi i64 [ %n.vec.i, %vec.epilog.iter.check.i ], [ 0, %vector.main.loop.iter.check.i ]
  %bc.merge.rdx.i = phi i1 [ %14, %vec.epilog.iter.check.i ], [ true, %vector.main.loop.iter.check.i ]
  %n.vec11.i = and i64 %.96, 9223372036854775804
  %16 = insertelement <4 x i1> <i1 poison, i1 true, i1 true, i1 true>, i1 %bc.merge.rdx.i, i64 0
  br label %vec.epilog.vector.body.i

vec.epilog.vector.body.i:
  %index12.i = phi i64 [ %vec.epilog.resume.val.i, %vec.epilog.ph.i ], [ %index.next15.i, %vec.epilog.vector.body.i ]
  %vec.phi13.i = phi <4 x i1> [ %16, %vec.epilog.ph.i ], [ %20, %vec.epilog.vector.body.i ]
  %17 = shl i64 %index12.i, 3
  %scevgep28.i = getelementptr i8, ptr %.93, i64 %17
  %wide.load14.i = load <4 x double>, ptr %scevgep28.i, align 8, !noalias !219
  %18 = call <4 x double> @llvm.fabs.v4f64(<4 x double> %wide.load14.i)
  %19 = fcmp one <4 x double> %18, splat (double 0x7FF0000000000000)
  %20 = and <4 x i1> %vec.phi13.i, %19
  %index.next15.i = add nuw i64 %index12.i, 4
  %21 = icmp eq i64 %n.vec11.i, %index.next15.i
  br i1 %21, label %vec.epilog.middle.block.i, label %vec.epilog.vector.body.i, !llvm.loop !223

vec.epilog.middle.block.i:
  %22 = bitcast <4 x i1> %20 to i4
  %23 = icmp eq i4 %22, -1
  %cmp.n16.i = icmp eq i64 %.96, %n.vec11.i
  br i1 %cmp.n16.i, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit, label %B40.i.preheader

B40.i.preheader:
  %good.2.043.i.ph = phi i1 [ true, %iter.check.i ], [ %14, %vec.epilog.iter.check.i ], [ %23, %vec.epilog.middle.block.i ]
  %.983941.i.ph = phi i64 [ 0, %iter.check.i ], [ %n.vec.i, %vec.epilog.iter.check.i ], [ %n.vec11.i, %vec.epilog.middle.block.i ]
  br label %B40.i

B40.i:
  %good.2.043.i = phi i1 [ %.136.i, %B40.i ], [ %good.2.043.i.ph, %B40.i.preheader ]
  %.983941.i = phi i64 [ %.105.i, %B40.i ], [ %.983941.i.ph, %B40.i.preheader ]
  %.105.i = add nuw nsw i64 %.983941.i, 1
  %24 = shl i64 %.983941.i, 3
  %scevgep.i = getelementptr i8, ptr %.93, i64 %24
  %.132.i = load double, ptr %scevgep.i, align 8, !noalias !219
  %25 = call double @llvm.fabs.f64(double %.132.i)
  %26 = fcmp one double %25, 0x7FF0000000000000
  %.136.i = and i1 %good.2.043.i, %26
  %exitcond.not.i = icmp eq i64 %.96, %.105.i
  br i1 %exitcond.not.i, label %_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit, label %B40.i, !llvm.loop !224

_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax.exit:
  %.136.lcssa.i = phi i1 [ %23, %vec.epilog.middle.block.i ], [ %14, %middle.block.i ], [ %.136.i, %B40.i ]
  br i1 %.136.lcssa.i, label %B404, label %B390

B390:
  store i64 4, ptr %retptr, align 8
  br label %common.ret

B404:
  %.158 = load i64, ptr %.30, align 8
  %.159 = inttoptr i64 %.158 to ptr
  %.167 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.163, ptr nonnull %excinfo.3, ptr nonnull %.93, ptr %.159, i64 %.96)
  switch i32 %.167, label %B404.if.if [
    i32 -2, label %B404.endif
    i32 0, label %B404.endif
  ], !prof !8

B0.endif:
  %.68 = getelementptr i8, ptr %arg.r, i64 768
  %.69 = load i64, ptr %.68, align 8
  %.70 = inttoptr i64 %.69 to ptr
  store double 0x7FF8000000000000, ptr %.70, align 8
  %.74 = getelementptr i8, ptr %arg.r, i64 16
  %.75 = load i64, ptr %.74, align 8
  %.77 = getelementptr i8, ptr %arg.r, i64 272
  %.78 = load i64, ptr %.77, align 8
  %.79 = inttoptr i64 %.78 to ptr
  %.82 = load i64, ptr %.17, align 8
  %.83 = inttoptr i64 %.82 to ptr
  %.86 = load i64, ptr %.68, align 8
  %.87 = inttoptr i64 %.86 to ptr
  %.88 = inttoptr i64 %.75 to ptr
  tail call void %.88(ptr %.79, ptr %.83, ptr %.87)
  %.92 = load i64, ptr %.68, align 8
  %.93 = inttoptr i64 %.92 to ptr
  %.96 = load i64, ptr %.39, align 8
  %.97 = getelementptr double, ptr %.93, i64 %.96
  %.98 = load double, ptr %.97, align 8
  %.99 = fcmp oeq double %.98, 0.000000e+00
  br i1 %.99, label %B324, label %B338

B0.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B404.endif:
  %.190 = load double, ptr %.12, align 8
  %.191 = fadd double %.190, 1.000000e+00
  store double %.191, ptr %.12, align 8
  %.199 = load double, ptr %.8, align 8
  %.201 = getelementptr i8, ptr %arg.r, i64 360
  store double %.199, ptr %.201, align 8
  %.205 = getelementptr i8, ptr %arg.r, i64 376
  store double %.199, ptr %.205, align 8
  %.209 = getelementptr i8, ptr %arg.r, i64 384
  tail call void @llvm.memset.p0.i64(ptr nonnull align 8 dereferenceable(16) %.209, i8 0, i64 16, i1 false)
  store i64 0, ptr %retptr, align 8
  br label %common.ret

B404.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret
}


define i64 @land(ptr %.1) local_unnamed_addr #0 {
entry:
  %.3 = alloca i64, align 8
  store i64 0, ptr %.3, align 8
  %excinfo = alloca ptr, align 8
  %.7 = call i32 @_ZN18biped_adrc_kernels4landB3v76B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3, ptr nonnull %excinfo, ptr %.1) #0
  %cond = icmp eq i32 %.7, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.17 = load i64, ptr %.3, align 8
  ret i64 %.17
}


define i32 @_ZN18biped_adrc_kernels13land_and_noteB3v77B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r) local_unnamed_addr #0 {
B0:
  %.38 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.91 = alloca ptr, align 8
  %excinfo.2 = alloca ptr, align 8
  %.8 = getelementptr i8, ptr %arg.r, i64 80
  %.9 = load i64, ptr %.8, align 8
  %.11 = getelementptr i8, ptr %arg.r, i64 552
  %.12 = load i64, ptr %.11, align 8
  %.13 = inttoptr i64 %.12 to ptr
  %.15 = getelementptr i8, ptr %arg.r, i64 480
  %.16 = load i64, ptr %.15, align 8
  %.20 = shl nsw i64 %.9, 1
  %.21 = or disjoint i64 %.20, 1
  %.22 = mul nsw i64 %.16, %.21
  %.23 = getelementptr double, ptr %.13, i64 %.22
  %.32 = getelementptr i8, ptr %arg.r, i64 696
  %.33 = load i64, ptr %.32, align 8
  %.34 = inttoptr i64 %.33 to ptr
  %.36 = getelementptr i8, ptr %.23, i64 8
  %.42 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.38, ptr nonnull %excinfo.1, ptr %.34, ptr %.36, i64 %.9)
  switch i32 %.42, label %B0.if.if [
    i32 -2, label %B0.endif
    i32 0, label %B0.endif
  ], !prof !8

B212:
  %.73 = getelementptr i8, ptr %arg.r, i64 344
  %.75 = load double, ptr %.73, align 8
  store double %.75, ptr %.23, align 8
  %.82 = load i64, ptr %.32, align 8
  %.83 = inttoptr i64 %.82 to ptr
  %0 = getelementptr double, ptr %.23, i64 %.9
  %.87 = getelementptr i8, ptr %0, i64 8
  %.95 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.91, ptr nonnull %excinfo.2, ptr %.83, ptr %.87, i64 %.9)
  switch i32 %.95, label %B212.if.if [
    i32 -2, label %B212.endif
    i32 0, label %B212.endif
  ], !prof !8

common.ret:
  %common.ret.op = phi i32 [ 0, %B342 ], [ %.42, %B0.if.if ], [ %.95, %B212.if.if ]
  ret i32 %common.ret.op

B342:
  store i64 %.65, ptr %retptr, align 8
  br label %common.ret

B0.endif:
  %.65 = tail call i64 @land(ptr nonnull %arg.r)
  %.70 = icmp eq i64 %.65, 0
  br i1 %.70, label %B212, label %B342

B0.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B212.endif:
  %.119 = load i64, ptr %.15, align 8
  %.120 = add nsw i64 %.119, 1
  store i64 %.120, ptr %.15, align 8
  br label %B342

B212.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret
}


define i64 @land_and_note(ptr %.1) local_unnamed_addr #0 {
entry:
  %.3 = alloca i64, align 8
  store i64 0, ptr %.3, align 8
  %excinfo = alloca ptr, align 8
  %.7 = call i32 @_ZN18biped_adrc_kernels13land_and_noteB3v77B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3, ptr nonnull %excinfo, ptr %.1) #0
  %cond = icmp eq i32 %.7, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.17 = load i64, ptr %.3, align 8
  ret i64 %.17
}


define i32 @_ZN18biped_adrc_kernels6strideB3v78B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr %arg.r) local_unnamed_addr #0 {
B0:
  %.8 = getelementptr i8, ptr %arg.r, i64 480
  %.9 = load i64, ptr %.8, align 8
  %.11 = getelementptr i8, ptr %arg.r, i64 472
  %.12 = load i64, ptr %.11, align 8
  %.13 = icmp slt i64 %.9, %.12
  br i1 %.13, label %B36, label %common.ret

B36:
  %.19 = tail call i64 @go_on(ptr nonnull %arg.r)
  switch i64 %.19, label %common.ret [
    i64 0, label %B88
    i64 9, label %B238
  ]

B88:
  %.27 = getelementptr i8, ptr %arg.r, i64 64
  %.28 = load i64, ptr %.27, align 8
  %.29.not = icmp eq i64 %.28, 0
  br i1 %.29.not, label %common.ret, label %B110

B110:
  %.32 = getelementptr i8, ptr %arg.r, i64 344
  %.34 = load double, ptr %.32, align 8
  %.36 = getelementptr i8, ptr %arg.r, i64 696
  %.37 = load i64, ptr %.36, align 8
  %.38 = inttoptr i64 %.37 to ptr
  %.40 = getelementptr i8, ptr %arg.r, i64 704
  %.41 = load i64, ptr %.40, align 8
  %.42 = inttoptr i64 %.41 to ptr
  %.44 = tail call ptr @node(ptr nonnull %arg.r, double %.34, ptr %.38, ptr %.42)
  br label %common.ret

common.ret:
  %.sink = phi i64 [ 1, %B110 ], [ 0, %B0 ], [ 1, %B88 ], [ %.74, %B238 ], [ %.19, %B36 ], [ 0, %B284 ]
  store i64 %.sink, ptr %retptr, align 8
  ret i32 0

B238:
  %.74 = tail call i64 @land_and_note(ptr nonnull %arg.r)
  %.79.not = icmp eq i64 %.74, 0
  br i1 %.79.not, label %B284, label %common.ret

B284:
  %.92 = load i64, ptr %.8, align 8
  %.95 = load i64, ptr %.11, align 8
  %.96 = icmp slt i64 %.92, %.95
  br i1 %.96, label %B36, label %common.ret
}


define i64 @stride(ptr %.1) local_unnamed_addr #0 {
entry:
  %.3 = alloca i64, align 8
  store i64 0, ptr %.3, align 8
  %.7 = call i32 @_ZN18biped_adrc_kernels6strideB3v78B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3, ptr nonnull poison, ptr %.1) #0
  %.17 = load i64, ptr %.3, align 8
  ret i64 %.17
}


define i32 @_ZN18biped_adrc_kernels6sampleB3v79B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr %arg.r) local_unnamed_addr #0 {
B0.endif.endif:
  %.128 = getelementptr i8, ptr %arg.r, i64 344
  %.158 = getelementptr i8, ptr %arg.r, i64 216
  %.8.i = getelementptr i8, ptr %arg.r, i64 152
  %.130.pre = load double, ptr %.128, align 8
  %.9.i.pre = load i64, ptr %.8.i, align 8, !noalias !225
  %.160.pre = load double, ptr %.158, align 8
  %sunkaddr = getelementptr i8, ptr %arg.r, i64 368
  br label %B46.endif

B190:
  %.197 = tail call i64 @land(ptr nonnull %arg.r)
  br label %B220

B220:
  %code.2.1 = phi i64 [ %.197, %B190 ], [ %.190, %B46.endif.endif ]
  %.202.not = icmp eq i64 %code.2.1, 0
  br i1 %.202.not, label %B250.endif, label %common.ret

common.ret:
  %.sink = phi i64 [ 0, %B250.endif ], [ %code.2.1, %B220 ], [ 7, %B348 ]
  store i64 %.sink, ptr %retptr, align 8
  ret i32 0

B348:
  %.88 = icmp samesign ugt i64 %.8798, 1
  br i1 %.88, label %B46.endif, label %common.ret

B46.endif:
  %.160 = phi double [ %.160.pre, %B0.endif.endif ], [ %.249, %B348 ]
  %.9.i = phi i64 [ %.9.i.pre, %B0.endif.endif ], [ %.9.i25, %B348 ]
  %.130 = phi double [ %.130.pre, %B0.endif.endif ], [ %.219, %B348 ]
  %.8798 = phi i64 [ 100, %B0.endif.endif ], [ %.97, %B348 ]
  %.97 = add nsw i64 %.8798, -1
  %.10.i = icmp eq i64 %.9.i, 1
  %"$phi52.0.2.0.in.v.i" = select i1 %.10.i, i64 376, i64 232
  %"$phi52.0.2.0.in.i" = getelementptr i8, ptr %arg.r, i64 %"$phi52.0.2.0.in.v.i"
  %"$phi52.0.2.0.i" = load double, ptr %"$phi52.0.2.0.in.i", align 8, !noalias !225
  %.15.i = fsub double %.130, %"$phi52.0.2.0.i"
  %.20.i = fdiv double %.15.i, %.160
  %.21.i = tail call double @llvm.floor.f64(double %.20.i)
  %.22.i = fptosi double %.21.i to i64
  %.13.i.i = tail call i64 @llvm.smax.i64(i64 %.22.i, i64 0)
  %.60.i = uitofp nneg i64 %.13.i.i to double
  %.61.i = fmul double %.160, %.60.i
  %.63.i = fadd double %"$phi52.0.2.0.i", %.61.i
  %.65.i = fcmp ugt double %.63.i, %.130
  br i1 %.65.i, label %B46.endif.endif, label %B108.i

B108.i:
  %lsr.iv.in = phi i64 [ %lsr.iv, %B108.i ], [ %.13.i.i, %B46.endif ]
  %lsr.iv = add i64 %lsr.iv.in, 1
  %.74.i = uitofp nneg i64 %lsr.iv to double
  %.75.i = fmul double %.160, %.74.i
  %.77.i = fadd double %"$phi52.0.2.0.i", %.75.i
  %.79.i = fcmp ugt double %.77.i, %.130
  br i1 %.79.i, label %B46.endif.endif, label %B108.i

B46.endif.endif:
  %.94.pre-phi.i = phi double [ %.63.i, %B46.endif ], [ %.77.i, %B108.i ]
  store double %.94.pre-phi.i, ptr %sunkaddr, align 8
  %.190 = tail call i64 @go_on(ptr nonnull %arg.r)
  %.194 = icmp eq i64 %.190, 9
  br i1 %.194, label %B190, label %B220

B250.endif:
  %.219 = load double, ptr %.128, align 8
  %.9.i25 = load i64, ptr %.8.i, align 8, !noalias !228
  %.10.i26 = icmp eq i64 %.9.i25, 1
  %"$phi52.0.2.0.in.v.i27" = select i1 %.10.i26, i64 376, i64 232
  %"$phi52.0.2.0.in.i28" = getelementptr i8, ptr %arg.r, i64 %"$phi52.0.2.0.in.v.i27"
  %"$phi52.0.2.0.i29" = load double, ptr %"$phi52.0.2.0.in.i28", align 8, !noalias !228
  %.249 = load double, ptr %.158, align 8
  %.7.i = fsub double %.219, %"$phi52.0.2.0.i29"
  %.11.i = fdiv double %.7.i, %.249
  %.12.i = fadd double %.11.i, 5.000000e-01
  %.13.i = tail call double @llvm.floor.f64(double %.12.i)
  %.14.i = fptosi double %.13.i to i64
  %.15.i30 = sitofp i64 %.14.i to double
  %.16.i = fmul double %.249, %.15.i30
  %.17.i = fadd double %"$phi52.0.2.0.i29", %.16.i
  %.18.i = fcmp une double %.219, %.17.i
  br i1 %.18.i, label %B348, label %common.ret
}


define i64 @sample(ptr %.1) local_unnamed_addr #0 {
entry:
  %.3 = alloca i64, align 8
  store i64 0, ptr %.3, align 8
  %.7 = call i32 @_ZN18biped_adrc_kernels6sampleB3v79B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3, ptr nonnull poison, ptr %.1) #0
  %.17 = load i64, ptr %.3, align 8
  ret i64 %.17
}

define i32 @_ZN18biped_adrc_kernels4lookB3v80B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr initializes((504, 512)) %arg.r, i64 %arg.law, ptr %arg.out) local_unnamed_addr {
B0:
  %.8 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.41 = alloca ptr, align 8
  %excinfo.2 = alloca ptr, align 8
  store ptr null, ptr %excinfo.2, align 8
  %.12 = call i32 @_ZN18biped_adrc_kernels5lowerB3v70B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a(ptr nonnull %.8, ptr nonnull %excinfo.1, ptr %arg.r)
  switch i32 %.12, label %B0.if.if [
    i32 -2, label %B0.endif
    i32 0, label %B0.endif
  ], !prof !8

B0.endif:
  %.34 = getelementptr i8, ptr %arg.r, i64 512
  store double 0x7FF0000000000000, ptr %.34, align 8
  %.38 = getelementptr i8, ptr %arg.r, i64 696
  %.39 = load i64, ptr %.38, align 8
  %.40 = inttoptr i64 %.39 to ptr
  %.45 = call i32 @_ZN18biped_adrc_kernels7measureB3v16B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a(ptr nonnull %.41, ptr nonnull %excinfo.2, ptr %arg.r, ptr %.40)
  %cond = icmp eq i32 %.45, 0
  br i1 %cond, label %B0.endif.endif, label %B0.endif.if.if, !prof !24

common.ret:
  %common.ret.op = phi i32 [ %.12, %B0.if.if ], [ 0, %B0.endif.endif ], [ %.45, %B0.endif.if.if ]
  ret i32 %common.ret.op

B0.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B0.endif.endif:
  %.65 = getelementptr i8, ptr %arg.r, i64 272
  %.66 = load i64, ptr %.65, align 8
  %.67 = inttoptr i64 %.66 to ptr
  %.68 = getelementptr i8, ptr %arg.r, i64 640
  %.69 = load i64, ptr %.68, align 8
  %.70 = inttoptr i64 %.69 to ptr
  %.71 = inttoptr i64 %arg.law to ptr
  tail call void %.71(ptr %.67, ptr %.70, ptr %arg.out)
  store ptr null, ptr %retptr, align 8
  br label %common.ret

B0.endif.if.if:
  %.53 = icmp sgt i32 %.45, 0
  %.46 = load ptr, ptr %excinfo.2, align 8
  %.54 = select i1 %.53, ptr %.46, ptr undef
  store ptr %.54, ptr %excinfo, align 8
  br label %common.ret
}


define ptr @look(ptr initializes((504, 512)) %.1, i64 %.2, ptr %.3) local_unnamed_addr #0 {
entry:
  %.5 = alloca ptr, align 8
  store ptr null, ptr %.5, align 8
  %excinfo = alloca ptr, align 8
  %.9 = call i32 @_ZN18biped_adrc_kernels4lookB3v80B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a(ptr nonnull %.5, ptr nonnull %excinfo, ptr %.1, i64 %.2, ptr %.3) #0
  %cond = icmp eq i32 %.9, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.19 = load ptr, ptr %.5, align 8
  ret ptr %.19
}


define i32 @_ZN18biped_adrc_kernels4pushB3v81B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add(ptr noalias writeonly initializes((0, 8)) %retptr, ptr noalias readnone %excinfo, ptr %arg.r, double %arg.x, double %arg.z) local_unnamed_addr #0 {
B0:
  %.3.i = alloca ptr, align 8
  %.14 = getelementptr i8, ptr %arg.r, i64 336
  %.15 = load i64, ptr %.14, align 8
  %.16 = inttoptr i64 %.15 to ptr
  %.22 = load double, ptr %.16, align 8
  %.24 = fcmp une double %arg.x, %.22
  br i1 %.24, label %B66, label %B42

B42:
  %.27 = getelementptr i8, ptr %.16, i64 8
  %.28 = load double, ptr %.27, align 8
  %.30 = fcmp une double %arg.z, %.28
  br i1 %.30, label %B66, label %common.ret

B66:
  %.33 = getelementptr i8, ptr %arg.r, i64 64
  %.34 = load i64, ptr %.33, align 8
  %.35.not = icmp eq i64 %.34, 0
  br i1 %.35.not, label %B202.endif, label %B88

B88:
  %.38 = getelementptr i8, ptr %arg.r, i64 344
  %.40 = load double, ptr %.38, align 8
  %.42 = getelementptr i8, ptr %arg.r, i64 696
  %.43 = load i64, ptr %.42, align 8
  %.44 = inttoptr i64 %.43 to ptr
  %.46 = getelementptr i8, ptr %arg.r, i64 704
  %.47 = load i64, ptr %.46, align 8
  %.48 = inttoptr i64 %.47 to ptr
  %.50 = tail call ptr @node(ptr nonnull %arg.r, double %.40, ptr %.44, ptr %.48)
  %.110.pre = load double, ptr %.16, align 8
  br label %B202.endif

B252:
  %.123 = getelementptr i8, ptr %.16, i64 8
  %.124 = load double, ptr %.123, align 8
  %.125 = fcmp une double %.124, 0.000000e+00
  %.neg = sext i1 %.125 to i64
  br label %B274.endif

common.ret:
  store ptr null, ptr %retptr, align 8
  ret i32 0

B202.endif:
  %.110 = phi double [ %.22, %B66 ], [ %.110.pre, %B88 ]
  %.53 = getelementptr i8, ptr %arg.r, i64 200
  %.54 = load i64, ptr %.53, align 8
  %.56 = fcmp une double %arg.x, 0.000000e+00
  %.72 = fcmp une double %arg.z, 0.000000e+00
  %"$phi202.4.2.0" = select i1 %.56, i1 true, i1 %.72
  %.15.i = zext i1 %"$phi202.4.2.0" to i64
  %.111 = fcmp une double %.110, 0.000000e+00
  br i1 %.111, label %B274.endif, label %B252

B274.endif:
  %"$phi274.5.2.0.neg" = phi i64 [ -1, %B202.endif ], [ %.neg, %B252 ]
  %.160 = add i64 %.54, %.15.i
  %.164 = add i64 %.160, %"$phi274.5.2.0.neg"
  store i64 %.164, ptr %.53, align 8
  store double %arg.x, ptr %.16, align 8
  %.180 = getelementptr i8, ptr %.16, i64 8
  store double %arg.z, ptr %.180, align 8
  %.7.i = call i32 @_ZN18biped_adrc_kernels7load_ofB2v1B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3.i, ptr nonnull poison, ptr nonnull readonly %arg.r) #0
  br label %common.ret
}


define ptr @push(ptr %.1, double %.2, double %.3) local_unnamed_addr #0 {
entry:
  %.5 = alloca ptr, align 8
  %.9 = call i32 @_ZN18biped_adrc_kernels4pushB3v81B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add(ptr nonnull %.5, ptr nonnull poison, ptr %.1, double %.2, double %.3) #0
  %.19 = load ptr, ptr %.5, align 8
  ret ptr %.19
}


define i32 @_ZN18biped_adrc_kernels5looksB3v82B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axx8int64_2a10float64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.walks, i64 %arg.count, i64 %arg.width, ptr readonly %arg.laws, ptr %arg.views) local_unnamed_addr #0 {
B0.endif:
  %.9847.not = icmp slt i64 %arg.count, 1
  br i1 %.9847.not, label %B182, label %B36.preheader

B36.preheader:
  %0 = shl i64 %arg.width, 3
  br label %B36

B36:
  %lsr.iv = phi ptr [ %arg.views, %B36.preheader ], [ %scevgep, %B180 ]
  %.1044648 = phi i64 [ 0, %B36.preheader ], [ %.111, %B180 ]
  %.111 = add nuw nsw i64 %.1044648, 1
  %1 = shl i64 %.1044648, 3
  %scevgep2 = getelementptr i8, ptr %arg.walks, i64 %1
  %.142 = load i64, ptr %scevgep2, align 8
  %.143.not = icmp eq i64 %.142, 0
  br i1 %.143.not, label %B180, label %B62

B62:
  %.149 = inttoptr i64 %.142 to ptr
  %scevgep1 = getelementptr i8, ptr %arg.laws, i64 %1
  %.153 = load i64, ptr %scevgep1, align 8
  %.161 = tail call ptr @look(ptr nonnull %.149, i64 %.153, ptr %lsr.iv)
  br label %B180

B180:
  %scevgep = getelementptr i8, ptr %lsr.iv, i64 %0
  %exitcond.not = icmp eq i64 %arg.count, %.111
  br i1 %exitcond.not, label %B182, label %B36

B182:
  store ptr null, ptr %retptr, align 8
  ret i32 0
}


define noalias ptr @looks(ptr readonly %.1, i64 %.2, i64 %.3, ptr readonly %.4, ptr %.5) local_unnamed_addr #0 {
entry:
  %.9847.not.i = icmp slt i64 %.2, 1
  br i1 %.9847.not.i, label %_ZN18biped_adrc_kernels5looksB3v82B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axx8int64_2a10float64_2a.exit, label %B36.preheader.i

B36.preheader.i:
  %0 = shl i64 %.3, 3
  br label %B36.i

B36.i:
  %lsr.iv.i = phi ptr [ %.5, %B36.preheader.i ], [ %scevgep.i, %B180.i ]
  %.1044648.i = phi i64 [ 0, %B36.preheader.i ], [ %.111.i, %B180.i ]
  %.111.i = add nuw nsw i64 %.1044648.i, 1
  %1 = shl i64 %.1044648.i, 3
  %scevgep2.i = getelementptr i8, ptr %.1, i64 %1
  %.142.i = load i64, ptr %scevgep2.i, align 8, !noalias !231
  %.143.not.i = icmp eq i64 %.142.i, 0
  br i1 %.143.not.i, label %B180.i, label %B62.i

B62.i:
  %.149.i = inttoptr i64 %.142.i to ptr
  %scevgep1.i = getelementptr i8, ptr %.4, i64 %1
  %.153.i = load i64, ptr %scevgep1.i, align 8, !noalias !231
  %.161.i = tail call ptr @look(ptr nonnull %.149.i, i64 %.153.i, ptr %lsr.iv.i), !noalias !231
  br label %B180.i

B180.i:
  %scevgep.i = getelementptr i8, ptr %lsr.iv.i, i64 %0
  %exitcond.not.i = icmp eq i64 %.2, %.111.i
  br i1 %exitcond.not.i, label %_ZN18biped_adrc_kernels5looksB3v82B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axx8int64_2a10float64_2a.exit, label %B36.i

_ZN18biped_adrc_kernels5looksB3v82B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axx8int64_2a10float64_2a.exit:
  ret ptr null
}


define i32 @_ZN18biped_adrc_kernels10move_aloneB3v83B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr %arg.r) local_unnamed_addr #0 {
B0:
  %.9 = getelementptr i8, ptr %arg.r, i64 216
  %.11.pre = load double, ptr %.9, align 8
  %sunkaddr = getelementptr i8, ptr %arg.r, i64 488
  %sunkaddr30 = getelementptr i8, ptr %arg.r, i64 368
  %sunkaddr31 = getelementptr i8, ptr %arg.r, i64 416
  %sunkaddr23 = getelementptr i8, ptr %arg.r, i64 344
  %sunkaddr24 = getelementptr i8, ptr %arg.r, i64 152
  %sunkaddr27 = getelementptr i8, ptr %arg.r, i64 480
  %sunkaddr28 = getelementptr i8, ptr %arg.r, i64 472
  br label %B6

B6:
  %.11 = phi double [ %.11.pre, %B0 ], [ %.224, %B6.backedge ]
  %.12 = fcmp ogt double %.11, 0.000000e+00
  %.17 = load double, ptr %sunkaddr, align 8
  br i1 %.12, label %B28, label %B108.endif

B28:
  %.8.i = load double, ptr %sunkaddr23, align 8, !noalias !234
  %.9.i.i = load i64, ptr %sunkaddr24, align 8, !noalias !237
  %.10.i.i = icmp eq i64 %.9.i.i, 1
  %"$phi52.0.2.0.in.v.i.i" = select i1 %.10.i.i, i64 376, i64 232
  %"$phi52.0.2.0.in.i.i" = getelementptr i8, ptr %arg.r, i64 %"$phi52.0.2.0.in.v.i.i"
  %"$phi52.0.2.0.i.i" = load double, ptr %"$phi52.0.2.0.in.i.i", align 8, !noalias !237
  %.15.i.i = fsub double %.8.i, %"$phi52.0.2.0.i.i"
  %.20.i.i = fdiv double %.15.i.i, %.11
  %.21.i.i = tail call double @llvm.floor.f64(double %.20.i.i)
  %.22.i.i = fptosi double %.21.i.i to i64
  %.13.i.i.i = tail call i64 @llvm.smax.i64(i64 %.22.i.i, i64 0)
  %.60.i.i = uitofp nneg i64 %.13.i.i.i to double
  %.61.i.i = fmul double %.11, %.60.i.i
  %.63.i.i = fadd double %"$phi52.0.2.0.i.i", %.61.i.i
  %.65.i.i = fcmp ugt double %.63.i.i, %.8.i
  br i1 %.65.i.i, label %B28.endif, label %B108.i.i

B108.i.i:
  %lsr.iv.in = phi i64 [ %lsr.iv, %B108.i.i ], [ %.13.i.i.i, %B28 ]
  %lsr.iv = add i64 %lsr.iv.in, 1
  %.74.i.i = uitofp nneg i64 %lsr.iv to double
  %.75.i.i = fmul double %.11, %.74.i.i
  %.77.i.i = fadd double %"$phi52.0.2.0.i.i", %.75.i.i
  %.79.i.i = fcmp ugt double %.77.i.i, %.8.i
  br i1 %.79.i.i, label %B28.endif, label %B108.i.i

common.ret:
  %.sink = phi i64 [ 1, %B348 ], [ 1, %B326 ], [ -1, %B280 ], [ %code.2.1, %B480 ], [ -1, %B108.endif ], [ 0, %B492 ], [ -1, %B550.endif.endif.endif ]
  store i64 %.sink, ptr %retptr, align 8
  ret i32 0

B280:
  %.150 = load double, ptr %sunkaddr23, align 8
  %.154 = load double, ptr %sunkaddr, align 8
  %.155 = fcmp olt double %.150, %.154
  br i1 %.155, label %common.ret, label %B326

B326:
  %.162 = getelementptr i8, ptr %arg.r, i64 64
  %.163 = load i64, ptr %.162, align 8
  %.164.not = icmp eq i64 %.163, 0
  br i1 %.164.not, label %common.ret, label %B348

B348:
  %.171 = getelementptr i8, ptr %arg.r, i64 696
  %.172 = load i64, ptr %.171, align 8
  %.173 = inttoptr i64 %.172 to ptr
  %.175 = getelementptr i8, ptr %arg.r, i64 704
  %.176 = load i64, ptr %.175, align 8
  %.177 = inttoptr i64 %.176 to ptr
  %.179 = tail call ptr @node(ptr nonnull %arg.r, double %.150, ptr %.173, ptr %.177)
  br label %common.ret

B450:
  %.197 = tail call i64 @land_and_note(ptr nonnull %arg.r)
  br label %B480

B480:
  %code.2.1 = phi i64 [ %.197, %B450 ], [ %.126, %B108.endif ]
  %.202.not = icmp eq i64 %code.2.1, 0
  br i1 %.202.not, label %B492, label %common.ret

B492:
  %.206 = load i64, ptr %sunkaddr27, align 8
  %.209 = load i64, ptr %sunkaddr28, align 8
  %.210 = icmp eq i64 %.206, %.209
  br i1 %.210, label %common.ret, label %B528

B528:
  %.224 = load double, ptr %.9, align 8
  %.225 = fcmp ogt double %.224, 0.000000e+00
  br i1 %.225, label %B550.endif.endif.endif, label %B6.backedge

B6.backedge:
  br label %B6

B28.endif:
  %.94.pre-phi.i.i = phi double [ %.63.i.i, %B28 ], [ %.77.i.i, %B108.i.i ]
  %.12.i = fcmp olt double %.94.pre-phi.i.i, %.17
  %.13.i = select i1 %.12.i, double %.94.pre-phi.i.i, double %.17
  br label %B108.endif

B108.endif:
  %"$phi108.0.2.1" = phi double [ %.13.i, %B28.endif ], [ %.17, %B6 ]
  store double %"$phi108.0.2.1", ptr %sunkaddr30, align 8
  %.96 = fcmp oeq double %.11, 0.000000e+00
  %.15.i = zext i1 %.96 to i64
  store i64 %.15.i, ptr %sunkaddr31, align 8
  %.126 = tail call i64 @go_on(ptr nonnull %arg.r)
  store i64 0, ptr %sunkaddr31, align 8
  switch i64 %.126, label %B480 [
    i64 10, label %common.ret
    i64 0, label %B280
    i64 9, label %B450
  ]

B550.endif.endif.endif:
  %.231 = load double, ptr %sunkaddr23, align 8
  %.9.i = load i64, ptr %sunkaddr24, align 8, !noalias !240
  %.10.i = icmp eq i64 %.9.i, 1
  %"$phi52.0.2.0.in.v.i" = select i1 %.10.i, i64 376, i64 232
  %"$phi52.0.2.0.in.i" = getelementptr i8, ptr %arg.r, i64 %"$phi52.0.2.0.in.v.i"
  %"$phi52.0.2.0.i" = load double, ptr %"$phi52.0.2.0.in.i", align 8, !noalias !240
  %.7.i = fsub double %.231, %"$phi52.0.2.0.i"
  %.11.i = fdiv double %.7.i, %.224
  %.12.i15 = fadd double %.11.i, 5.000000e-01
  %.13.i16 = tail call double @llvm.floor.f64(double %.12.i15)
  %.14.i = fptosi double %.13.i16 to i64
  %.15.i17 = sitofp i64 %.14.i to double
  %.16.i = fmul double %.224, %.15.i17
  %.17.i = fadd double %"$phi52.0.2.0.i", %.16.i
  %.18.i = fcmp une double %.231, %.17.i
  br i1 %.18.i, label %B6.backedge, label %common.ret
}


define i64 @move_alone(ptr %.1) local_unnamed_addr #0 {
entry:
  %.3 = alloca i64, align 8
  store i64 0, ptr %.3, align 8
  %.7 = call i32 @_ZN18biped_adrc_kernels10move_aloneB3v83B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3, ptr nonnull poison, ptr %.1) #0
  %.17 = load i64, ptr %.3, align 8
  ret i64 %.17
}


define i32 @_ZN18biped_adrc_kernels8is_plainB3v85B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr %arg.r) local_unnamed_addr #0 {
B0:
  %.110 = alloca double, align 8
  %excinfo.1 = alloca ptr, align 8
  store ptr null, ptr %excinfo.1, align 8
  %.340 = alloca double, align 8
  %excinfo.7 = alloca ptr, align 8
  %.8 = getelementptr i8, ptr %arg.r, i64 344
  %.10 = load double, ptr %.8, align 8
  %.12 = getelementptr i8, ptr %arg.r, i64 224
  %.14 = load double, ptr %.12, align 8
  %.16 = getelementptr i8, ptr %arg.r, i64 392
  %.17 = load i64, ptr %.16, align 8
  %.18 = icmp eq i64 %.17, 1
  br i1 %.18, label %B80, label %B80.thread

B80:
  %.34 = getelementptr i8, ptr %arg.r, i64 376
  %.36 = load double, ptr %.34, align 8
  %.37 = fcmp ogt double %.10, %.36
  %.60 = getelementptr i8, ptr %arg.r, i64 216
  %.62 = load double, ptr %.60, align 8
  %.63 = fcmp oeq double %.62, 0.000000e+00
  br i1 %.63, label %B108, label %B276

B80.thread:
  %.6031 = getelementptr i8, ptr %arg.r, i64 216
  %.6232 = load double, ptr %.6031, align 8
  %.6333 = fcmp oeq double %.6232, 0.000000e+00
  br i1 %.6333, label %B108.thread, label %B276

B108.thread:
  %.7038 = getelementptr i8, ptr %arg.r, i64 488
  %.7239 = load double, ptr %.7038, align 8
  %.7440 = getelementptr i8, ptr %arg.r, i64 368
  store double %.7239, ptr %.7440, align 8
  br label %B260.endif

B108:
  %.70 = getelementptr i8, ptr %arg.r, i64 488
  %.72 = load double, ptr %.70, align 8
  %.74 = getelementptr i8, ptr %arg.r, i64 368
  store double %.72, ptr %.74, align 8
  br i1 %.37, label %B148, label %B260.endif

B148:
  %.91 = getelementptr i8, ptr %arg.r, i64 424
  %.92 = load i64, ptr %.91, align 8
  %.93 = icmp sgt i64 %.92, 0
  br i1 %.93, label %B174, label %B260.endif

B174:
  %.105 = getelementptr i8, ptr %arg.r, i64 432
  %.107 = load double, ptr %.105, align 8
  store double 0.000000e+00, ptr %.110, align 8
  %.114 = call i32 @_ZN18biped_adrc_kernels10next_breakB3v73B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a(ptr nonnull %.110, ptr nonnull %excinfo.1, ptr nonnull %arg.r)
  %cond = icmp eq i32 %.114, 0
  br i1 %cond, label %B174.endif.endif, label %B174.if.if, !prof !24

B276:
  %.574 = phi double [ %.6232, %B80.thread ], [ %.62, %B80 ]
  %"$phi80.2.2.035" = phi i1 [ false, %B80.thread ], [ %.37, %B80 ]
  %.8.i.i = getelementptr i8, ptr %arg.r, i64 152
  %.9.i.i = load i64, ptr %.8.i.i, align 8, !noalias !243
  %.10.i.i = icmp eq i64 %.9.i.i, 1
  %"$phi52.0.2.0.in.v.i.i" = select i1 %.10.i.i, i64 376, i64 232
  %"$phi52.0.2.0.in.i.i" = getelementptr i8, ptr %arg.r, i64 %"$phi52.0.2.0.in.v.i.i"
  %"$phi52.0.2.0.i.i" = load double, ptr %"$phi52.0.2.0.in.i.i", align 8, !noalias !243
  %.15.i.i = fsub double %.10, %"$phi52.0.2.0.i.i"
  %.20.i.i = fdiv double %.15.i.i, %.574
  %.21.i.i = tail call double @llvm.floor.f64(double %.20.i.i)
  %.22.i.i = fptosi double %.21.i.i to i64
  %.13.i.i.i = tail call i64 @llvm.smax.i64(i64 %.22.i.i, i64 0)
  %.60.i.i = uitofp nneg i64 %.13.i.i.i to double
  %.61.i.i = fmul double %.574, %.60.i.i
  %.63.i.i = fadd double %"$phi52.0.2.0.i.i", %.61.i.i
  %.65.i.i = fcmp ugt double %.63.i.i, %.10
  br i1 %.65.i.i, label %B276.endif, label %B108.i.i

B108.i.i:
  %lsr.iv95.in = phi i64 [ %lsr.iv95, %B108.i.i ], [ %.13.i.i.i, %B276 ]
  %lsr.iv95 = add i64 %lsr.iv95.in, 1
  %.74.i.i = uitofp nneg i64 %lsr.iv95 to double
  %.75.i.i = fmul double %.574, %.74.i.i
  %.77.i.i = fadd double %"$phi52.0.2.0.i.i", %.75.i.i
  %.79.i.i = fcmp ugt double %.77.i.i, %.10
  br i1 %.79.i.i, label %B276.endif, label %B108.i.i

B384:
  %.328 = getelementptr i8, ptr %arg.r, i64 488
  %.330 = load double, ptr %.328, align 8
  %.332 = fcmp ugt double %.94.pre-phi.i.i, %.330
  br i1 %.332, label %B446, label %B406

B406:
  store double 0.000000e+00, ptr %.340, align 8
  %.344 = call i32 @_ZN18biped_adrc_kernels11next_switchB3v74B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add(ptr nonnull %.340, ptr nonnull %excinfo.7, ptr nonnull %arg.r, double %.10, double %.94.pre-phi.i.i)
  switch i32 %.344, label %B406.if.if [
    i32 -2, label %B406.endif
    i32 0, label %B406.endif
  ], !prof !8

B446:
  %"$phi446.0.3.0" = phi i1 [ %.365, %B406.endif ], [ false, %B384 ], [ false, %B276.endif ]
  %.376 = fcmp oeq double %.14, 0.000000e+00
  br i1 %.376, label %B460, label %B572

B446.thread:
  %.37626 = fcmp oeq double %.14, 0.000000e+00
  br i1 %.37626, label %B556.endif, label %B572

B460:
  br i1 %"$phi446.0.3.0", label %B476.endif.endif, label %B556.endif

B572:
  %"$phi446.0.3.028" = phi i1 [ false, %B446.thread ], [ %"$phi446.0.3.0", %B446 ]
  %.39.i = fadd double %.14, %"$phi52.0.2.0.i.i"
  %.15.i.i18 = fsub double %.10, %.39.i
  %.20.i.i19 = fdiv double %.15.i.i18, %.574
  %.21.i.i20 = tail call double @llvm.floor.f64(double %.20.i.i19)
  %.22.i.i21 = fptosi double %.21.i.i20 to i64
  %.13.i.i.i22 = tail call i64 @llvm.smax.i64(i64 %.22.i.i21, i64 0)
  %.60.i.i23 = uitofp nneg i64 %.13.i.i.i22 to double
  %.61.i.i24 = fmul double %.574, %.60.i.i23
  %.63.i.i25 = fadd double %.39.i, %.61.i.i24
  %.65.i.i26 = fcmp ugt double %.63.i.i25, %.10
  br i1 %.65.i.i26, label %B572.endif, label %B108.i.i27

B108.i.i27:
  %lsr.iv.in = phi i64 [ %lsr.iv, %B108.i.i27 ], [ %.13.i.i.i22, %B572 ]
  %lsr.iv = add i64 %lsr.iv.in, 1
  %.74.i.i30 = uitofp nneg i64 %lsr.iv to double
  %.75.i.i31 = fmul double %.574, %.74.i.i30
  %.77.i.i32 = fadd double %.39.i, %.75.i.i31
  %.79.i.i33 = fcmp ugt double %.77.i.i32, %.10
  br i1 %.79.i.i33, label %B572.endif, label %B108.i.i27

B698:
  %.7.i35 = fsub double %.94.pre-phi.i.i, %.94.pre-phi.i.i34
  %.8.i36 = getelementptr i8, ptr %arg.r, i64 248
  %.10.i37 = load double, ptr %.8.i36, align 8, !noalias !248
  %.14.i38 = fdiv double %.7.i35, %.10.i37
  %.15.i39 = fadd double %.14.i38, -1.000000e-09
  %.23.le.i40 = tail call double @llvm.ceil.f64(double %.15.i39)
  %.12.i.i41 = fcmp ogt double %.23.le.i40, 1.000000e+00
  %.13.i.i42 = select i1 %.12.i.i41, double %.23.le.i40, double 1.000000e+00
  %.5.i.i43 = fptosi double %.13.i.i42 to i64
  %.7.i76 = fsub double %.574, %.14
  %.14.i79 = fdiv double %.7.i76, %.10.i37
  %.15.i80 = fadd double %.14.i79, -1.000000e-09
  %.23.le.i81 = tail call double @llvm.ceil.f64(double %.15.i80)
  %.12.i.i82 = fcmp ogt double %.23.le.i81, 1.000000e+00
  %.13.i.i83 = select i1 %.12.i.i82, double %.23.le.i81, double 1.000000e+00
  %.5.i.i84 = fptosi double %.13.i.i83 to i64
  %.601 = icmp eq i64 %.5.i.i43, %.5.i.i84
  br i1 %.601, label %B716.endif.endif, label %B786.endif

common.ret:
  %common.ret.op = phi i32 [ %.114, %B174.if.if ], [ %.344, %B406.if.if ], [ 0, %B260.endif ], [ 0, %B786.endif ], [ 0, %B556.endif ]
  ret i32 %common.ret.op

B174.if.if:
  %.122 = icmp sgt i32 %.114, 0
  %.115 = load ptr, ptr %excinfo.1, align 8
  %.123 = select i1 %.122, ptr %.115, ptr undef
  store ptr %.123, ptr %excinfo, align 8
  br label %common.ret

B174.endif.endif:
  %.124 = load double, ptr %.110, align 8
  %.7.i55 = fsub double %.124, %.107
  %.8.i56 = getelementptr i8, ptr %arg.r, i64 248
  %.10.i57 = load double, ptr %.8.i56, align 8, !noalias !251
  %.14.i58 = fdiv double %.7.i55, %.10.i57
  %.15.i59 = fadd double %.14.i58, -1.000000e-09
  %.23.le.i60 = tail call double @llvm.ceil.f64(double %.15.i59)
  %.12.i.i61 = fcmp ogt double %.23.le.i60, 1.000000e+00
  %.13.i.i62 = select i1 %.12.i.i61, double %.23.le.i60, double 1.000000e+00
  %.5.i.i63 = fptosi double %.13.i.i62 to i64
  %.163 = add nsw i64 %.5.i.i63, -1
  %.165 = icmp slt i64 %.92, %.163
  %0 = zext i1 %.165 to i64
  br label %B260.endif

B260.endif:
  %"$phi260.2.3.0" = phi i64 [ %0, %B174.endif.endif ], [ 0, %B108 ], [ 0, %B148 ], [ 0, %B108.thread ]
  store i64 %"$phi260.2.3.0", ptr %retptr, align 8
  br label %common.ret

B276.endif:
  %.94.pre-phi.i.i = phi double [ %.63.i.i, %B276 ], [ %.77.i.i, %B108.i.i ]
  br i1 %"$phi80.2.2.035", label %B310.endif, label %B446

B310.endif:
  %.12.i = fadd double %.20.i.i, 5.000000e-01
  %.13.i = tail call double @llvm.floor.f64(double %.12.i)
  %.14.i65 = fptosi double %.13.i to i64
  %.15.i66 = sitofp i64 %.14.i65 to double
  %.16.i = fmul double %.574, %.15.i66
  %.17.i = fadd double %"$phi52.0.2.0.i.i", %.16.i
  %.18.i = fcmp une double %.10, %.17.i
  br i1 %.18.i, label %B446.thread, label %B384

B406.endif:
  %.354 = load double, ptr %.340, align 8
  %.365 = fcmp oeq double %.354, %.94.pre-phi.i.i
  br label %B446

B406.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B476.endif.endif:
  %.7.i2 = fsub double %.94.pre-phi.i.i, %.10
  %.8.i3 = getelementptr i8, ptr %arg.r, i64 248
  %.10.i4 = load double, ptr %.8.i3, align 8, !noalias !254
  %.14.i = fdiv double %.7.i2, %.10.i4
  %.15.i5 = fadd double %.14.i, -1.000000e-09
  %.23.le.i = tail call double @llvm.ceil.f64(double %.15.i5)
  %.12.i.i = fcmp ogt double %.23.le.i, 1.000000e+00
  %.13.i.i = select i1 %.12.i.i, double %.23.le.i, double 1.000000e+00
  %.5.i.i = fptosi double %.13.i.i to i64
  %.14.i70 = fdiv double %.574, %.10.i4
  %.15.i71 = fadd double %.14.i70, -1.000000e-09
  %.23.le.i72 = tail call double @llvm.ceil.f64(double %.15.i71)
  %.12.i.i73 = fcmp ogt double %.23.le.i72, 1.000000e+00
  %.13.i.i74 = select i1 %.12.i.i73, double %.23.le.i72, double 1.000000e+00
  %.5.i.i75 = fptosi double %.13.i.i74 to i64
  %.455 = icmp eq i64 %.5.i.i, %.5.i.i75
  %1 = zext i1 %.455 to i64
  br label %B556.endif

B556.endif:
  %"$phi556.2.2.0" = phi i64 [ %1, %B476.endif.endif ], [ 0, %B460 ], [ 0, %B446.thread ]
  store i64 %"$phi556.2.2.0", ptr %retptr, align 8
  br label %common.ret

B572.endif:
  %.94.pre-phi.i.i34 = phi double [ %.63.i.i25, %B572 ], [ %.77.i.i32, %B108.i.i27 ]
  %.536 = fcmp olt double %.94.pre-phi.i.i34, %.94.pre-phi.i.i
  %or.cond = and i1 %"$phi446.0.3.028", %.536
  br i1 %or.cond, label %B698, label %B786.endif

B716.endif.endif:
  %.7.i44 = fsub double %.94.pre-phi.i.i34, %.10
  %.14.i47 = fdiv double %.7.i44, %.10.i37
  %.15.i48 = fadd double %.14.i47, -1.000000e-09
  %.23.le.i49 = tail call double @llvm.ceil.f64(double %.15.i48)
  %.12.i.i50 = fcmp ogt double %.23.le.i49, 1.000000e+00
  %.13.i.i51 = select i1 %.12.i.i50, double %.23.le.i49, double 1.000000e+00
  %.5.i.i52 = fptosi double %.13.i.i51 to i64
  %.14.i88 = fdiv double %.14, %.10.i37
  %.15.i89 = fadd double %.14.i88, -1.000000e-09
  %.23.le.i90 = tail call double @llvm.ceil.f64(double %.15.i89)
  %.12.i.i91 = fcmp ogt double %.23.le.i90, 1.000000e+00
  %.13.i.i92 = select i1 %.12.i.i91, double %.23.le.i90, double 1.000000e+00
  %.5.i.i93 = fptosi double %.13.i.i92 to i64
  %.680 = icmp eq i64 %.5.i.i52, %.5.i.i93
  %2 = zext i1 %.680 to i64
  br label %B786.endif

B786.endif:
  %"$phi786.2.2.0" = phi i64 [ %2, %B716.endif.endif ], [ 0, %B698 ], [ 0, %B572.endif ]
  store i64 %"$phi786.2.2.0", ptr %retptr, align 8
  br label %common.ret
}


define i64 @is_plain(ptr %.1) local_unnamed_addr #0 {
entry:
  %.3 = alloca i64, align 8
  store i64 0, ptr %.3, align 8
  %excinfo = alloca ptr, align 8
  %.7 = call i32 @_ZN18biped_adrc_kernels8is_plainB3v85B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3, ptr nonnull %excinfo, ptr %.1) #0
  %cond = icmp eq i32 %.7, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.17 = load i64, ptr %.3, align 8
  ret i64 %.17
}


define i32 @_ZN18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.s, i64 %arg.lane, ptr readonly %arg.x, ptr writeonly %arg.out, i64 %arg.size) local_unnamed_addr #5 {
B0.endif:
  %invariant.gep = getelementptr double, ptr %arg.out, i64 %arg.lane
  %.9841.not = icmp slt i64 %arg.size, 1
  br i1 %.9841.not, label %B84, label %B36.lr.ph

B36.lr.ph:
  %xtraiter = and i64 %arg.size, 7
  %0 = icmp samesign ult i64 %arg.size, 8
  br i1 %0, label %B36.epil.preheader, label %B36.lr.ph.new

B36.lr.ph.new:
  %1 = and i64 %arg.size, 9223372036854775800
  %sunkaddr = getelementptr i8, ptr %arg.s, i64 568
  br label %B36

B36:
  %lsr.iv2 = phi i64 [ %lsr.iv.next3, %B36 ], [ 7, %B36.lr.ph.new ]
  %2 = add nsw i64 %lsr.iv2, -7
  %3 = add nsw i64 %lsr.iv2, -6
  %4 = shl i64 %lsr.iv2, 3
  %scevgep17 = getelementptr i8, ptr %arg.x, i64 %4
  %scevgep18 = getelementptr i8, ptr %scevgep17, i64 -56
  %.138 = load double, ptr %scevgep18, align 8
  %.141 = load i64, ptr %sunkaddr, align 8
  %.142 = mul nsw i64 %.141, %2
  %gep = getelementptr double, ptr %invariant.gep, i64 %.142
  store double %.138, ptr %gep, align 8
  %5 = add nsw i64 %lsr.iv2, -5
  %scevgep16 = getelementptr i8, ptr %scevgep17, i64 -48
  %.138.1 = load double, ptr %scevgep16, align 8
  %.141.1 = load i64, ptr %sunkaddr, align 8
  %.142.1 = mul nsw i64 %.141.1, %3
  %gep.1 = getelementptr double, ptr %invariant.gep, i64 %.142.1
  store double %.138.1, ptr %gep.1, align 8
  %6 = add nsw i64 %lsr.iv2, -4
  %scevgep14 = getelementptr i8, ptr %scevgep17, i64 -40
  %.138.2 = load double, ptr %scevgep14, align 8
  %.141.2 = load i64, ptr %sunkaddr, align 8
  %.142.2 = mul nsw i64 %.141.2, %5
  %gep.2 = getelementptr double, ptr %invariant.gep, i64 %.142.2
  store double %.138.2, ptr %gep.2, align 8
  %7 = add nsw i64 %lsr.iv2, -3
  %scevgep12 = getelementptr i8, ptr %scevgep17, i64 -32
  %.138.3 = load double, ptr %scevgep12, align 8
  %.141.3 = load i64, ptr %sunkaddr, align 8
  %.142.3 = mul nsw i64 %.141.3, %6
  %gep.3 = getelementptr double, ptr %invariant.gep, i64 %.142.3
  store double %.138.3, ptr %gep.3, align 8
  %8 = add nsw i64 %lsr.iv2, -2
  %scevgep10 = getelementptr i8, ptr %scevgep17, i64 -24
  %.138.4 = load double, ptr %scevgep10, align 8
  %.141.4 = load i64, ptr %sunkaddr, align 8
  %.142.4 = mul nsw i64 %.141.4, %7
  %gep.4 = getelementptr double, ptr %invariant.gep, i64 %.142.4
  store double %.138.4, ptr %gep.4, align 8
  %9 = add nsw i64 %lsr.iv2, -1
  %scevgep8 = getelementptr i8, ptr %scevgep17, i64 -16
  %.138.5 = load double, ptr %scevgep8, align 8
  %.141.5 = load i64, ptr %sunkaddr, align 8
  %.142.5 = mul nsw i64 %.141.5, %8
  %gep.5 = getelementptr double, ptr %invariant.gep, i64 %.142.5
  store double %.138.5, ptr %gep.5, align 8
  %scevgep6 = getelementptr i8, ptr %scevgep17, i64 -8
  %.138.6 = load double, ptr %scevgep6, align 8
  %.141.6 = load i64, ptr %sunkaddr, align 8
  %.142.6 = mul nsw i64 %.141.6, %9
  %gep.6 = getelementptr double, ptr %invariant.gep, i64 %.142.6
  store double %.138.6, ptr %gep.6, align 8
  %.138.7 = load double, ptr %scevgep17, align 8
  %.141.7 = load i64, ptr %sunkaddr, align 8
  %.142.7 = mul nsw i64 %.141.7, %lsr.iv2
  %gep.7 = getelementptr double, ptr %invariant.gep, i64 %.142.7
  store double %.138.7, ptr %gep.7, align 8
  %lsr.iv.next3 = add nuw nsw i64 %lsr.iv2, 8
  %10 = sub nsw i64 %lsr.iv.next3, %1
  %niter.ncmp.7 = icmp eq i64 %10, 7
  br i1 %niter.ncmp.7, label %B84.loopexit.unr-lcssa, label %B36

B84.loopexit.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  %11 = add nuw i64 %lsr.iv2, 1
  br i1 %lcmp.mod.not, label %B84, label %B36.epil.preheader

B36.epil.preheader:
  %.1044042.epil.init = phi i64 [ 0, %B36.lr.ph ], [ %11, %B84.loopexit.unr-lcssa ]
  %sunkaddr19 = getelementptr i8, ptr %arg.s, i64 568
  br label %B36.epil

B36.epil:
  %lsr.iv = phi i64 [ %lsr.iv.next, %B36.epil ], [ %xtraiter, %B36.epil.preheader ]
  %.1044042.epil = phi i64 [ %.111.epil, %B36.epil ], [ %.1044042.epil.init, %B36.epil.preheader ]
  %.111.epil = add nuw nsw i64 %.1044042.epil, 1
  %12 = shl i64 %.1044042.epil, 3
  %scevgep = getelementptr i8, ptr %arg.x, i64 %12
  %.138.epil = load double, ptr %scevgep, align 8
  %.141.epil = load i64, ptr %sunkaddr19, align 8
  %.142.epil = mul nsw i64 %.141.epil, %.1044042.epil
  %gep.epil = getelementptr double, ptr %invariant.gep, i64 %.142.epil
  store double %.138.epil, ptr %gep.epil, align 8
  %lsr.iv.next = add nsw i64 %lsr.iv, -1
  %epil.iter.cmp.not = icmp eq i64 %lsr.iv.next, 0
  br i1 %epil.iter.cmp.not, label %B84, label %B36.epil, !llvm.loop !257

B84:
  store ptr null, ptr %retptr, align 8
  ret i32 0
}


define ptr @put(ptr readonly %.1, i64 %.2, ptr readonly %.3, ptr writeonly %.4, i64 %.5) local_unnamed_addr #6 {
entry:
  %.7 = alloca ptr, align 8
  store ptr null, ptr %.7, align 8
  %.11 = call i32 @_ZN18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.7, ptr nonnull poison, ptr %.1, i64 %.2, ptr %.3, ptr %.4, i64 %.5) #0
  %.21 = load ptr, ptr %.7, align 8
  ret ptr %.21
}


define i32 @_ZN18biped_adrc_kernels3getB3v91B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.s, i64 %arg.lane, ptr readonly %arg.x, ptr writeonly %arg.out, i64 %arg.size) local_unnamed_addr #5 {
B0.endif:
  %invariant.gep = getelementptr double, ptr %arg.x, i64 %arg.lane
  %.9841.not = icmp slt i64 %arg.size, 1
  br i1 %.9841.not, label %B84, label %B36.lr.ph

B36.lr.ph:
  %xtraiter = and i64 %arg.size, 7
  %0 = icmp samesign ult i64 %arg.size, 8
  br i1 %0, label %B36.epil.preheader, label %B36.lr.ph.new

B36.lr.ph.new:
  %1 = and i64 %arg.size, 9223372036854775800
  %sunkaddr = getelementptr i8, ptr %arg.s, i64 568
  br label %B36

B36:
  %lsr.iv2 = phi i64 [ %lsr.iv.next3, %B36 ], [ 7, %B36.lr.ph.new ]
  %2 = add nsw i64 %lsr.iv2, -7
  %3 = add nsw i64 %lsr.iv2, -6
  %.138 = load i64, ptr %sunkaddr, align 8
  %.139 = mul nsw i64 %.138, %2
  %gep = getelementptr double, ptr %invariant.gep, i64 %.139
  %.144 = load double, ptr %gep, align 8
  %4 = shl i64 %lsr.iv2, 3
  %scevgep17 = getelementptr i8, ptr %arg.out, i64 %4
  %scevgep18 = getelementptr i8, ptr %scevgep17, i64 -56
  store double %.144, ptr %scevgep18, align 8
  %5 = add nsw i64 %lsr.iv2, -5
  %.138.1 = load i64, ptr %sunkaddr, align 8
  %.139.1 = mul nsw i64 %.138.1, %3
  %gep.1 = getelementptr double, ptr %invariant.gep, i64 %.139.1
  %.144.1 = load double, ptr %gep.1, align 8
  %scevgep16 = getelementptr i8, ptr %scevgep17, i64 -48
  store double %.144.1, ptr %scevgep16, align 8
  %6 = add nsw i64 %lsr.iv2, -4
  %.138.2 = load i64, ptr %sunkaddr, align 8
  %.139.2 = mul nsw i64 %.138.2, %5
  %gep.2 = getelementptr double, ptr %invariant.gep, i64 %.139.2
  %.144.2 = load double, ptr %gep.2, align 8
  %scevgep14 = getelementptr i8, ptr %scevgep17, i64 -40
  store double %.144.2, ptr %scevgep14, align 8
  %7 = add nsw i64 %lsr.iv2, -3
  %.138.3 = load i64, ptr %sunkaddr, align 8
  %.139.3 = mul nsw i64 %.138.3, %6
  %gep.3 = getelementptr double, ptr %invariant.gep, i64 %.139.3
  %.144.3 = load double, ptr %gep.3, align 8
  %scevgep12 = getelementptr i8, ptr %scevgep17, i64 -32
  store double %.144.3, ptr %scevgep12, align 8
  %8 = add nsw i64 %lsr.iv2, -2
  %.138.4 = load i64, ptr %sunkaddr, align 8
  %.139.4 = mul nsw i64 %.138.4, %7
  %gep.4 = getelementptr double, ptr %invariant.gep, i64 %.139.4
  %.144.4 = load double, ptr %gep.4, align 8
  %scevgep10 = getelementptr i8, ptr %scevgep17, i64 -24
  store double %.144.4, ptr %scevgep10, align 8
  %9 = add nsw i64 %lsr.iv2, -1
  %.138.5 = load i64, ptr %sunkaddr, align 8
  %.139.5 = mul nsw i64 %.138.5, %8
  %gep.5 = getelementptr double, ptr %invariant.gep, i64 %.139.5
  %.144.5 = load double, ptr %gep.5, align 8
  %scevgep8 = getelementptr i8, ptr %scevgep17, i64 -16
  store double %.144.5, ptr %scevgep8, align 8
  %.138.6 = load i64, ptr %sunkaddr, align 8
  %.139.6 = mul nsw i64 %.138.6, %9
  %gep.6 = getelementptr double, ptr %invariant.gep, i64 %.139.6
  %.144.6 = load double, ptr %gep.6, align 8
  %scevgep6 = getelementptr i8, ptr %scevgep17, i64 -8
  store double %.144.6, ptr %scevgep6, align 8
  %.138.7 = load i64, ptr %sunkaddr, align 8
  %.139.7 = mul nsw i64 %.138.7, %lsr.iv2
  %gep.7 = getelementptr double, ptr %invariant.gep, i64 %.139.7
  %.144.7 = load double, ptr %gep.7, align 8
  store double %.144.7, ptr %scevgep17, align 8
  %lsr.iv.next3 = add nuw nsw i64 %lsr.iv2, 8
  %10 = sub nsw i64 %lsr.iv.next3, %1
  %niter.ncmp.7 = icmp eq i64 %10, 7
  br i1 %niter.ncmp.7, label %B84.loopexit.unr-lcssa, label %B36

B84.loopexit.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  %11 = add nuw i64 %lsr.iv2, 1
  br i1 %lcmp.mod.not, label %B84, label %B36.epil.preheader

B36.epil.preheader:
  %.1044042.epil.init = phi i64 [ 0, %B36.lr.ph ], [ %11, %B84.loopexit.unr-lcssa ]
  %sunkaddr19 = getelementptr i8, ptr %arg.s, i64 568
  br label %B36.epil

B36.epil:
  %lsr.iv = phi i64 [ %lsr.iv.next, %B36.epil ], [ %xtraiter, %B36.epil.preheader ]
  %.1044042.epil = phi i64 [ %.111.epil, %B36.epil ], [ %.1044042.epil.init, %B36.epil.preheader ]
  %.111.epil = add nuw nsw i64 %.1044042.epil, 1
  %.138.epil = load i64, ptr %sunkaddr19, align 8
  %.139.epil = mul nsw i64 %.138.epil, %.1044042.epil
  %gep.epil = getelementptr double, ptr %invariant.gep, i64 %.139.epil
  %.144.epil = load double, ptr %gep.epil, align 8
  %12 = shl i64 %.1044042.epil, 3
  %scevgep = getelementptr i8, ptr %arg.out, i64 %12
  store double %.144.epil, ptr %scevgep, align 8
  %lsr.iv.next = add nsw i64 %lsr.iv, -1
  %epil.iter.cmp.not = icmp eq i64 %lsr.iv.next, 0
  br i1 %epil.iter.cmp.not, label %B84, label %B36.epil, !llvm.loop !258

B84:
  store ptr null, ptr %retptr, align 8
  ret i32 0
}


define ptr @get(ptr readonly %.1, i64 %.2, ptr readonly %.3, ptr writeonly %.4, i64 %.5) local_unnamed_addr #6 {
entry:
  %.7 = alloca ptr, align 8
  store ptr null, ptr %.7, align 8
  %.11 = call i32 @_ZN18biped_adrc_kernels3getB3v91B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.7, ptr nonnull poison, ptr %.1, i64 %.2, ptr %.3, ptr %.4, i64 %.5) #0
  %.21 = load ptr, ptr %.7, align 8
  ret ptr %.21
}


define i32 @_ZN18biped_adrc_kernels11put_numbersB3v92B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a(ptr noalias writeonly initializes((0, 8)) %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.s, i64 %arg.lane, ptr readonly %arg.r) local_unnamed_addr #6 {
B0:
  %.7.i1 = alloca ptr, align 8
  %.7.i = alloca ptr, align 8
  %.7 = getelementptr i8, ptr %arg.r, i64 272
  %.8 = load i64, ptr %.7, align 8
  %.9 = inttoptr i64 %.8 to ptr
  %.10 = getelementptr i8, ptr %arg.s, i64 272
  %.11 = load i64, ptr %.10, align 8
  %.12 = inttoptr i64 %.11 to ptr
  %.13 = getelementptr i8, ptr %arg.r, i64 168
  %.14 = load i64, ptr %.13, align 8
  %.11.i = call i32 @_ZN18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.7.i, ptr nonnull poison, ptr readonly %arg.s, i64 %arg.lane, ptr readonly %.9, ptr %.12, i64 %.14) #0
  %.16 = getelementptr i8, ptr %arg.r, i64 312
  %.17 = load i64, ptr %.16, align 8
  %.18 = inttoptr i64 %.17 to ptr
  %.19 = getelementptr i8, ptr %arg.s, i64 312
  %.20 = load i64, ptr %.19, align 8
  %.21 = inttoptr i64 %.20 to ptr
  %.22 = getelementptr i8, ptr %arg.r, i64 176
  %.23 = load i64, ptr %.22, align 8
  %.11.i2 = call i32 @_ZN18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.7.i1, ptr nonnull poison, ptr readonly %arg.s, i64 %arg.lane, ptr readonly %.18, ptr %.21, i64 %.23) #0
  store ptr null, ptr %retptr, align 8
  ret i32 0
}


define ptr @put_numbers(ptr readonly %.1, i64 %.2, ptr readonly %.3) local_unnamed_addr #6 {
entry:
  %.5 = alloca ptr, align 8
  %.9 = call i32 @_ZN18biped_adrc_kernels11put_numbersB3v92B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a(ptr nonnull %.5, ptr nonnull poison, ptr %.1, i64 %.2, ptr %.3) #0
  %.19 = load ptr, ptr %.5, align 8
  ret ptr %.19
}


define i32 @_ZN18biped_adrc_kernels5leaveB3v93B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a(ptr noalias writeonly initializes((0, 8)) %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.s, i64 %arg.lane, ptr readonly %arg.r, ptr readonly %arg.block) local_unnamed_addr #6 {
common.ret:
  %.7.i10 = alloca ptr, align 8
  %.7.i7 = alloca ptr, align 8
  %.7.i3 = alloca ptr, align 8
  %.7.i1 = alloca ptr, align 8
  %.7.i = getelementptr i8, ptr %arg.s, i64 584
  %.8.i = load i64, ptr %.7.i, align 8, !noalias !259
  %.9.i = inttoptr i64 %.8.i to ptr
  %.11.i = load i64, ptr %.9.i, align 8, !noalias !259
  %.12.i = getelementptr i8, ptr %arg.s, i64 568
  %.13.i = load i64, ptr %.12.i, align 8, !noalias !259
  %.14.i = mul nsw i64 %.13.i, %.11.i
  %.15.i = getelementptr double, ptr %arg.block, i64 %.14.i
  %.35 = getelementptr i8, ptr %arg.r, i64 696
  %.36 = load i64, ptr %.35, align 8
  %.37 = inttoptr i64 %.36 to ptr
  %.38 = getelementptr i8, ptr %arg.r, i64 80
  %.39 = load i64, ptr %.38, align 8
  %.11.i2 = call i32 @_ZN18biped_adrc_kernels3getB3v91B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.7.i1, ptr nonnull poison, ptr readonly %arg.s, i64 %arg.lane, ptr readonly %.15.i, ptr %.37, i64 %.39) #0
  %.8.i2 = load i64, ptr %.7.i, align 8, !noalias !262
  %.9.i3 = inttoptr i64 %.8.i2 to ptr
  %.10.i = getelementptr i8, ptr %.9.i3, i64 72
  %.11.i4 = load i64, ptr %.10.i, align 8, !noalias !262
  %.13.i6 = load i64, ptr %.12.i, align 8, !noalias !262
  %.14.i7 = mul nsw i64 %.13.i6, %.11.i4
  %.15.i8 = getelementptr double, ptr %arg.block, i64 %.14.i7
  %.66 = getelementptr i8, ptr %arg.r, i64 672
  %.67 = load i64, ptr %.66, align 8
  %.68 = inttoptr i64 %.67 to ptr
  %.69 = getelementptr i8, ptr %arg.r, i64 136
  %.70 = load i64, ptr %.69, align 8
  %.11.i5 = call i32 @_ZN18biped_adrc_kernels3getB3v91B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.7.i3, ptr nonnull poison, ptr readonly %arg.s, i64 %arg.lane, ptr readonly %.15.i8, ptr %.68, i64 %.70) #0
  %.8.i10 = load i64, ptr %.7.i, align 8, !noalias !265
  %.9.i11 = inttoptr i64 %.8.i10 to ptr
  %.10.i12 = getelementptr i8, ptr %.9.i11, i64 88
  %.11.i13 = load i64, ptr %.10.i12, align 8, !noalias !265
  %.13.i15 = load i64, ptr %.12.i, align 8, !noalias !265
  %.14.i16 = mul nsw i64 %.13.i15, %.11.i13
  %.15.i17 = getelementptr double, ptr %arg.block, i64 %.14.i16
  %.97 = getelementptr i8, ptr %arg.r, i64 704
  %.98 = load i64, ptr %.97, align 8
  %.99 = inttoptr i64 %.98 to ptr
  %.100 = getelementptr i8, ptr %arg.r, i64 96
  %.101 = load i64, ptr %.100, align 8
  %.11.i8 = call i32 @_ZN18biped_adrc_kernels3getB3v91B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.7.i7, ptr nonnull poison, ptr readonly %arg.s, i64 %arg.lane, ptr readonly %.15.i17, ptr %.99, i64 %.101) #0
  %.8.i19 = load i64, ptr %.7.i, align 8, !noalias !268
  %.9.i20 = inttoptr i64 %.8.i19 to ptr
  %.10.i21 = getelementptr i8, ptr %.9.i20, i64 112
  %.11.i22 = load i64, ptr %.10.i21, align 8, !noalias !268
  %.13.i24 = load i64, ptr %.12.i, align 8, !noalias !268
  %.14.i25 = mul nsw i64 %.13.i24, %.11.i22
  %.15.i26 = getelementptr double, ptr %arg.block, i64 %.14.i25
  %.128 = getelementptr i8, ptr %arg.r, i64 640
  %.129 = load i64, ptr %.128, align 8
  %.130 = inttoptr i64 %.129 to ptr
  %.132 = load i64, ptr %.38, align 8
  %0 = getelementptr double, ptr %.130, i64 %.132
  %.134 = getelementptr i8, ptr %0, i64 24
  %.135 = getelementptr i8, ptr %arg.r, i64 72
  %.136 = load i64, ptr %.135, align 8
  %.11.i11 = call i32 @_ZN18biped_adrc_kernels3getB3v91B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.7.i10, ptr nonnull poison, ptr readonly %arg.s, i64 %arg.lane, ptr readonly %.15.i26, ptr %.134, i64 %.136) #0
  store ptr null, ptr %retptr, align 8
  ret i32 0
}


define ptr @leave(ptr readonly %.1, i64 %.2, ptr readonly %.3, ptr readonly %.4) local_unnamed_addr #6 {
entry:
  %.6 = alloca ptr, align 8
  %.10 = call i32 @_ZN18biped_adrc_kernels5leaveB3v93B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a(ptr nonnull %.6, ptr nonnull poison, ptr %.1, i64 %.2, ptr %.3, ptr %.4) #0
  %.20 = load ptr, ptr %.6, align 8
  ret ptr %.20
}


define i32 @_ZN18biped_adrc_kernels12begin_sampleB3v98B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.s, i64 %arg.lane, ptr %arg.r, ptr writeonly %arg.block) local_unnamed_addr #7 {
B0:
  %.17 = getelementptr i8, ptr %arg.r, i64 216
  %.19 = load double, ptr %.17, align 8
  %.20 = fcmp ogt double %.19, 0.000000e+00
  br i1 %.20, label %B26, label %B56

B26:
  %.6.i = getelementptr i8, ptr %arg.r, i64 344
  %.8.i = load double, ptr %.6.i, align 8, !noalias !271
  %.8.i.i = getelementptr i8, ptr %arg.r, i64 152
  %.9.i.i = load i64, ptr %.8.i.i, align 8, !noalias !274
  %.10.i.i = icmp eq i64 %.9.i.i, 1
  %"$phi52.0.2.0.in.v.i.i" = select i1 %.10.i.i, i64 376, i64 232
  %"$phi52.0.2.0.in.i.i" = getelementptr i8, ptr %arg.r, i64 %"$phi52.0.2.0.in.v.i.i"
  %"$phi52.0.2.0.i.i" = load double, ptr %"$phi52.0.2.0.in.i.i", align 8, !noalias !274
  %.15.i.i = fsub double %.8.i, %"$phi52.0.2.0.i.i"
  %.20.i.i = fdiv double %.15.i.i, %.19
  %.21.i.i = tail call double @llvm.floor.f64(double %.20.i.i)
  %.22.i.i = fptosi double %.21.i.i to i64
  %.13.i.i.i = tail call i64 @llvm.smax.i64(i64 %.22.i.i, i64 0)
  %.60.i.i = uitofp nneg i64 %.13.i.i.i to double
  %.61.i.i = fmul double %.19, %.60.i.i
  %.63.i.i = fadd double %"$phi52.0.2.0.i.i", %.61.i.i
  %.65.i.i = fcmp ugt double %.63.i.i, %.8.i
  br i1 %.65.i.i, label %B106, label %B108.i.i

B108.i.i:
  %lsr.iv48.in = phi i64 [ %lsr.iv48, %B108.i.i ], [ %.13.i.i.i, %B26 ]
  %lsr.iv48 = add i64 %lsr.iv48.in, 1
  %.74.i.i = uitofp nneg i64 %lsr.iv48 to double
  %.75.i.i = fmul double %.19, %.74.i.i
  %.77.i.i = fadd double %"$phi52.0.2.0.i.i", %.75.i.i
  %.79.i.i = fcmp ugt double %.77.i.i, %.8.i
  br i1 %.79.i.i, label %B106, label %B108.i.i

B56:
  %.55 = getelementptr i8, ptr %arg.r, i64 432
  %.57 = load double, ptr %.55, align 8
  %.59 = getelementptr i8, ptr %arg.r, i64 424
  %.60 = load i64, ptr %.59, align 8
  %.61 = add nsw i64 %.60, 1
  %.63 = getelementptr i8, ptr %arg.r, i64 248
  %.65 = load double, ptr %.63, align 8
  %.66 = sitofp i64 %.61 to double
  %.67 = fmul double %.65, %.66
  %.68 = fadd double %.57, %.67
  %.79.phi.trans.insert = getelementptr i8, ptr %arg.r, i64 344
  %.81.pre = load double, ptr %.79.phi.trans.insert, align 8
  br label %B106

B106:
  %.81 = phi double [ %.81.pre, %B56 ], [ %.8.i, %B26 ], [ %.8.i, %B108.i.i ]
  %"$phi106.0.2.0" = phi double [ %.68, %B56 ], [ %.63.i.i, %B26 ], [ %.77.i.i, %B108.i.i ]
  %.84 = getelementptr double, ptr %arg.block, i64 %arg.lane
  store double %.81, ptr %.84, align 8
  %.87 = getelementptr i8, ptr %arg.r, i64 224
  %.89 = load double, ptr %.87, align 8
  %.90 = fcmp ogt double %.89, 0.000000e+00
  br i1 %.90, label %B150, label %common.ret

B150:
  %.79 = getelementptr i8, ptr %arg.r, i64 344
  %.8.i2 = load double, ptr %.79, align 8, !noalias !277
  %.8.i.i3 = getelementptr i8, ptr %arg.r, i64 152
  %.9.i.i4 = load i64, ptr %.8.i.i3, align 8, !noalias !280
  %.10.i.i5 = icmp eq i64 %.9.i.i4, 1
  %"$phi52.0.2.0.in.v.i.i6" = select i1 %.10.i.i5, i64 376, i64 232
  %"$phi52.0.2.0.in.i.i7" = getelementptr i8, ptr %arg.r, i64 %"$phi52.0.2.0.in.v.i.i6"
  %"$phi52.0.2.0.i.i8" = load double, ptr %"$phi52.0.2.0.in.i.i7", align 8, !noalias !280
  %.39.i = fadd double %.89, %"$phi52.0.2.0.i.i8"
  %.42.i = load double, ptr %.17, align 8, !noalias !277
  %.15.i.i11 = fsub double %.8.i2, %.39.i
  %.20.i.i12 = fdiv double %.15.i.i11, %.42.i
  %.21.i.i13 = tail call double @llvm.floor.f64(double %.20.i.i12)
  %.22.i.i14 = fptosi double %.21.i.i13 to i64
  %.13.i.i.i15 = tail call i64 @llvm.smax.i64(i64 %.22.i.i14, i64 0)
  %.60.i.i16 = uitofp nneg i64 %.13.i.i.i15 to double
  %.61.i.i17 = fmul double %.42.i, %.60.i.i16
  %.63.i.i18 = fadd double %.39.i, %.61.i.i17
  %.65.i.i19 = fcmp ugt double %.63.i.i18, %.8.i2
  br i1 %.65.i.i19, label %common.ret, label %B108.i.i20

B108.i.i20:
  %lsr.iv.in = phi i64 [ %lsr.iv, %B108.i.i20 ], [ %.13.i.i.i15, %B150 ]
  %lsr.iv = add i64 %lsr.iv.in, 1
  %.74.i.i23 = uitofp nneg i64 %lsr.iv to double
  %.75.i.i24 = fmul double %.42.i, %.74.i.i23
  %.77.i.i25 = fadd double %.39.i, %.75.i.i24
  %.79.i.i26 = fcmp ugt double %.77.i.i25, %.8.i2
  br i1 %.79.i.i26, label %common.ret, label %B108.i.i20

common.ret:
  %"$phi182.0.2.0" = phi double [ %"$phi106.0.2.0", %B106 ], [ %.63.i.i18, %B150 ], [ %.77.i.i25, %B108.i.i20 ]
  %.7.i = getelementptr i8, ptr %arg.s, i64 584
  %.8.i28 = load i64, ptr %.7.i, align 8, !noalias !283
  %.9.i = inttoptr i64 %.8.i28 to ptr
  %.10.i = getelementptr i8, ptr %.9.i, i64 56
  %.11.i = load i64, ptr %.10.i, align 8, !noalias !283
  %.12.i = getelementptr i8, ptr %arg.s, i64 568
  %.13.i = load i64, ptr %.12.i, align 8, !noalias !283
  %.14.i = mul nsw i64 %.13.i, %.11.i
  %.15.i = getelementptr double, ptr %arg.block, i64 %.14.i
  %.155 = getelementptr double, ptr %.15.i, i64 %arg.lane
  store double %"$phi182.0.2.0", ptr %.155, align 8
  %.8.i30 = load i64, ptr %.7.i, align 8, !noalias !286
  %.9.i31 = inttoptr i64 %.8.i30 to ptr
  %.10.i32 = getelementptr i8, ptr %.9.i31, i64 64
  %.11.i33 = load i64, ptr %.10.i32, align 8, !noalias !286
  %.13.i35 = load i64, ptr %.12.i, align 8, !noalias !286
  %.14.i36 = mul nsw i64 %.13.i35, %.11.i33
  %.15.i37 = getelementptr double, ptr %arg.block, i64 %.14.i36
  %.188 = getelementptr double, ptr %.15.i37, i64 %arg.lane
  store double %"$phi106.0.2.0", ptr %.188, align 8
  %.8.i39 = load i64, ptr %.7.i, align 8, !noalias !289
  %.9.i40 = inttoptr i64 %.8.i39 to ptr
  %.10.i41 = getelementptr i8, ptr %.9.i40, i64 80
  %.11.i42 = load i64, ptr %.10.i41, align 8, !noalias !289
  %.13.i44 = load i64, ptr %.12.i, align 8, !noalias !289
  %.14.i45 = mul nsw i64 %.13.i44, %.11.i42
  %.15.i46 = getelementptr double, ptr %arg.block, i64 %.14.i45
  %.224 = getelementptr double, ptr %.15.i46, i64 %arg.lane
  store double 1.000000e+00, ptr %.224, align 8
  %.229 = getelementptr i8, ptr %arg.r, i64 408
  %.230 = load i64, ptr %.229, align 8
  %.232 = getelementptr i8, ptr %arg.r, i64 440
  store i64 %.230, ptr %.232, align 8
  store ptr null, ptr %retptr, align 8
  ret i32 0
}


define ptr @begin_sample(ptr readonly %.1, i64 %.2, ptr %.3, ptr writeonly %.4) local_unnamed_addr #6 {
entry:
  %.6 = alloca ptr, align 8
  store ptr null, ptr %.6, align 8
  %.10 = call i32 @_ZN18biped_adrc_kernels12begin_sampleB3v98B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a(ptr nonnull %.6, ptr nonnull poison, ptr %.1, i64 %.2, ptr %.3, ptr %.4) #0
  %.20 = load ptr, ptr %.6, align 8
  ret ptr %.20
}


define i32 @_ZN18biped_adrc_kernels5enterB4v102B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a(ptr noalias writeonly initializes((0, 8)) %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.s, i64 %arg.lane, ptr %arg.r, ptr writeonly %arg.block) local_unnamed_addr #6 {
common.ret:
  %.6.i = alloca ptr, align 8
  %.7.i10 = alloca ptr, align 8
  %.7.i7 = alloca ptr, align 8
  %.7.i3 = alloca ptr, align 8
  %.7.i1 = alloca ptr, align 8
  %.8 = getelementptr i8, ptr %arg.r, i64 696
  %.9 = load i64, ptr %.8, align 8
  %.7.i = getelementptr i8, ptr %arg.s, i64 584
  %.8.i = load i64, ptr %.7.i, align 8, !noalias !292
  %.9.i = inttoptr i64 %.8.i to ptr
  %.11.i = load i64, ptr %.9.i, align 8, !noalias !292
  %.12.i = getelementptr i8, ptr %arg.s, i64 568
  %.13.i = load i64, ptr %.12.i, align 8, !noalias !292
  %.14.i = mul nsw i64 %.13.i, %.11.i
  %.15.i = getelementptr double, ptr %arg.block, i64 %.14.i
  %.10 = inttoptr i64 %.9 to ptr
  %.38 = getelementptr i8, ptr %arg.r, i64 80
  %.39 = load i64, ptr %.38, align 8
  %.11.i2 = call i32 @_ZN18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.7.i1, ptr nonnull poison, ptr readonly %arg.s, i64 %arg.lane, ptr readonly %.10, ptr %.15.i, i64 %.39) #0
  %.41 = getelementptr i8, ptr %arg.r, i64 672
  %.42 = load i64, ptr %.41, align 8
  %.8.i2 = load i64, ptr %.7.i, align 8, !noalias !295
  %.9.i3 = inttoptr i64 %.8.i2 to ptr
  %.10.i = getelementptr i8, ptr %.9.i3, i64 72
  %.11.i4 = load i64, ptr %.10.i, align 8, !noalias !295
  %.13.i6 = load i64, ptr %.12.i, align 8, !noalias !295
  %.14.i7 = mul nsw i64 %.13.i6, %.11.i4
  %.15.i8 = getelementptr double, ptr %arg.block, i64 %.14.i7
  %.43 = inttoptr i64 %.42 to ptr
  %.69 = getelementptr i8, ptr %arg.r, i64 136
  %.70 = load i64, ptr %.69, align 8
  %.11.i5 = call i32 @_ZN18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.7.i3, ptr nonnull poison, ptr readonly %arg.s, i64 %arg.lane, ptr readonly %.43, ptr %.15.i8, i64 %.70) #0
  %.72 = getelementptr i8, ptr %arg.r, i64 704
  %.73 = load i64, ptr %.72, align 8
  %.8.i10 = load i64, ptr %.7.i, align 8, !noalias !298
  %.9.i11 = inttoptr i64 %.8.i10 to ptr
  %.10.i12 = getelementptr i8, ptr %.9.i11, i64 88
  %.11.i13 = load i64, ptr %.10.i12, align 8, !noalias !298
  %.13.i15 = load i64, ptr %.12.i, align 8, !noalias !298
  %.14.i16 = mul nsw i64 %.13.i15, %.11.i13
  %.15.i17 = getelementptr double, ptr %arg.block, i64 %.14.i16
  %.74 = inttoptr i64 %.73 to ptr
  %.100 = getelementptr i8, ptr %arg.r, i64 96
  %.101 = load i64, ptr %.100, align 8
  %.11.i8 = call i32 @_ZN18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.7.i7, ptr nonnull poison, ptr readonly %arg.s, i64 %arg.lane, ptr readonly %.74, ptr %.15.i17, i64 %.101) #0
  %.103 = getelementptr i8, ptr %arg.r, i64 352
  %.105 = load double, ptr %.103, align 8
  %.106 = getelementptr i8, ptr %arg.r, i64 360
  %.108 = load double, ptr %.106, align 8
  %.110 = load i64, ptr %.12.i, align 8
  %0 = getelementptr double, ptr %arg.block, i64 %.110
  %.112 = getelementptr double, ptr %0, i64 %arg.lane
  store double %.105, ptr %.112, align 8
  %.115 = load i64, ptr %.12.i, align 8
  %.idx = shl i64 %.115, 4
  %1 = getelementptr i8, ptr %arg.block, i64 %.idx
  %.118 = getelementptr double, ptr %1, i64 %arg.lane
  store double %.108, ptr %.118, align 8
  %.120 = getelementptr i8, ptr %arg.r, i64 504
  %.122 = load double, ptr %.120, align 8
  %.8.i19 = load i64, ptr %.7.i, align 8, !noalias !301
  %.9.i20 = inttoptr i64 %.8.i19 to ptr
  %.10.i21 = getelementptr i8, ptr %.9.i20, i64 32
  %.11.i22 = load i64, ptr %.10.i21, align 8, !noalias !301
  %.13.i24 = load i64, ptr %.12.i, align 8, !noalias !301
  %.14.i25 = mul nsw i64 %.13.i24, %.11.i22
  %.15.i26 = getelementptr double, ptr %arg.block, i64 %.14.i25
  %.148 = getelementptr double, ptr %.15.i26, i64 %arg.lane
  store double %.122, ptr %.148, align 8
  %.150 = getelementptr i8, ptr %arg.r, i64 264
  %.152 = load double, ptr %.150, align 8
  %.8.i28 = load i64, ptr %.7.i, align 8, !noalias !304
  %.9.i29 = inttoptr i64 %.8.i28 to ptr
  %.10.i30 = getelementptr i8, ptr %.9.i29, i64 40
  %.11.i31 = load i64, ptr %.10.i30, align 8, !noalias !304
  %.13.i33 = load i64, ptr %.12.i, align 8, !noalias !304
  %.14.i34 = mul nsw i64 %.13.i33, %.11.i31
  %.15.i35 = getelementptr double, ptr %arg.block, i64 %.14.i34
  %.178 = getelementptr double, ptr %.15.i35, i64 %arg.lane
  store double %.152, ptr %.178, align 8
  %.180 = getelementptr i8, ptr %arg.r, i64 296
  %.181 = load i64, ptr %.180, align 8
  %.8.i37 = load i64, ptr %.7.i, align 8, !noalias !307
  %.9.i38 = inttoptr i64 %.8.i37 to ptr
  %.10.i39 = getelementptr i8, ptr %.9.i38, i64 48
  %.11.i40 = load i64, ptr %.10.i39, align 8, !noalias !307
  %.13.i42 = load i64, ptr %.12.i, align 8, !noalias !307
  %.14.i43 = mul nsw i64 %.13.i42, %.11.i40
  %.15.i44 = getelementptr double, ptr %arg.block, i64 %.14.i43
  %.182 = inttoptr i64 %.181 to ptr
  %.208 = getelementptr i8, ptr %arg.r, i64 72
  %.209 = load i64, ptr %.208, align 8
  %.11.i11 = call i32 @_ZN18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.7.i10, ptr nonnull poison, ptr nonnull readonly %arg.s, i64 %arg.lane, ptr readonly %.182, ptr %.15.i44, i64 %.209) #0
  %.10.i13 = call i32 @_ZN18biped_adrc_kernels12begin_sampleB3v98B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a(ptr nonnull %.6.i, ptr nonnull poison, ptr nonnull readonly %arg.s, i64 %arg.lane, ptr nonnull %arg.r, ptr nonnull %arg.block) #0
  store ptr null, ptr %retptr, align 8
  ret i32 0
}


define ptr @enter(ptr readonly %.1, i64 %.2, ptr %.3, ptr writeonly %.4) local_unnamed_addr #6 {
entry:
  %.6 = alloca ptr, align 8
  %.10 = call i32 @_ZN18biped_adrc_kernels5enterB4v102B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a(ptr nonnull %.6, ptr nonnull poison, ptr %.1, i64 %.2, ptr %.3, ptr %.4) #0
  %.20 = load ptr, ptr %.6, align 8
  ret ptr %.20
}

define i32 @_ZN18biped_adrc_kernels11store_nodesB4v106B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.s, i64 %arg.load_of) local_unnamed_addr {
B0:
  %.7.i1 = alloca ptr, align 8
  %.11 = getelementptr i8, ptr %arg.s, i64 64
  %.12 = load i64, ptr %.11, align 8
  %.13.not = icmp eq i64 %.12, 0
  br i1 %.13.not, label %common.ret, label %B28.endif.endif

B264:
  %.1735355 = phi i64 [ %.180, %B686 ], [ 0, %B264.preheader ]
  %.180 = add nuw nsw i64 %.1735355, 1
  %.210 = load i64, ptr %sunkaddr, align 8
  %.211 = inttoptr i64 %.210 to ptr
  %0 = shl i64 %.1735355, 3
  %scevgep5 = getelementptr i8, ptr %.211, i64 %0
  %.214 = load i64, ptr %scevgep5, align 8
  %.215.not = icmp eq i64 %.214, 0
  br i1 %.215.not, label %B686, label %B300.endif

B686:
  %exitcond.not = icmp eq i64 %.13.i, %.180
  br i1 %exitcond.not, label %common.ret, label %B264

common.ret:
  store ptr null, ptr %retptr, align 8
  ret i32 0

B28.endif.endif:
  %.19 = getelementptr i8, ptr %arg.s, i64 272
  %.20 = load i64, ptr %.19, align 8
  %.21 = inttoptr i64 %.20 to ptr
  %.23 = getelementptr i8, ptr %arg.s, i64 600
  %.24 = load i64, ptr %.23, align 8
  %.25 = inttoptr i64 %.24 to ptr
  %.27 = getelementptr i8, ptr %arg.s, i64 608
  %.28 = load i64, ptr %.27, align 8
  %.29 = inttoptr i64 %.28 to ptr
  %.30 = inttoptr i64 %.12 to ptr
  tail call void %.30(ptr %.21, ptr %.25, ptr %.29)
  %.35 = load i64, ptr %.23, align 8
  %.36 = inttoptr i64 %.35 to ptr
  %.7.i = getelementptr i8, ptr %arg.s, i64 584
  %.8.i = load i64, ptr %.7.i, align 8, !noalias !310
  %.9.i = inttoptr i64 %.8.i to ptr
  %.10.i = getelementptr i64, ptr %.9.i, i64 %arg.load_of
  %.11.i = load i64, ptr %.10.i, align 8, !noalias !310
  %.12.i = getelementptr i8, ptr %arg.s, i64 568
  %.13.i = load i64, ptr %.12.i, align 8, !noalias !310
  %.14.i = mul i64 %.13.i, %.11.i
  %.15.i = getelementptr double, ptr %.36, i64 %.14.i
  %.68 = getelementptr i8, ptr %arg.s, i64 72
  %.69 = load i64, ptr %.68, align 8
  %.73 = mul i64 %.69, %.13.i
  %.74 = getelementptr double, ptr %.15.i, i64 %.73
  %.76 = getelementptr i8, ptr %arg.s, i64 456
  %.77 = load i64, ptr %.76, align 8
  %.78 = add nsw i64 %.77, -4
  %.16754.not = icmp slt i64 %.13.i, 1
  br i1 %.16754.not, label %common.ret, label %B264.preheader

B264.preheader:
  %sunkaddr = getelementptr i8, ptr %arg.s, i64 616
  br label %B264

B300.endif:
  %.224 = inttoptr i64 %.214 to ptr
  %.225 = getelementptr i8, ptr %.224, i64 560
  %.226 = load i64, ptr %.225, align 8
  %.227 = inttoptr i64 %.226 to ptr
  %.228 = getelementptr i8, ptr %.224, i64 408
  %.229 = load i64, ptr %.228, align 8
  %.230 = getelementptr i8, ptr %.224, i64 456
  %.231 = load i64, ptr %.230, align 8
  %.232 = mul nsw i64 %.231, %.229
  %.233 = getelementptr double, ptr %.227, i64 %.232
  %.236 = load i64, ptr %.23, align 8
  %.237 = inttoptr i64 %.236 to ptr
  %scevgep4 = getelementptr i8, ptr %.237, i64 %0
  %.240 = load double, ptr %scevgep4, align 8
  %.241 = getelementptr i8, ptr %.224, i64 352
  %.243 = load double, ptr %.241, align 8
  store double %.240, ptr %.233, align 8
  %.246 = getelementptr i8, ptr %.233, i64 8
  store double %.243, ptr %.246, align 8
  %scevgep3 = getelementptr i8, ptr %.74, i64 %0
  %.251 = load double, ptr %scevgep3, align 8
  %.254 = load i64, ptr %.12.i, align 8
  %1 = shl i64 %.254, 3
  %scevgep = getelementptr i8, ptr %.74, i64 %1
  %scevgep2 = getelementptr i8, ptr %scevgep, i64 %0
  %.259 = load double, ptr %scevgep2, align 8
  %.260 = getelementptr i8, ptr %.233, i64 16
  store double %.251, ptr %.260, align 8
  %.262 = getelementptr i8, ptr %.233, i64 24
  store double %.259, ptr %.262, align 8
  %.266 = load i64, ptr %.27, align 8
  %.267 = inttoptr i64 %.266 to ptr
  %.268 = getelementptr i8, ptr %.233, i64 32
  %.11.i2 = call i32 @_ZN18biped_adrc_kernels3getB3v91B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.7.i1, ptr nonnull poison, ptr nonnull readonly %arg.s, i64 %.1735355, ptr readonly %.267, ptr %.268, i64 %.78) #0
  %.276 = load i64, ptr %.228, align 8
  %.277 = add nsw i64 %.276, 1
  %.278 = getelementptr i8, ptr %.224, i64 448
  %.279 = load i64, ptr %.278, align 8
  %.280 = add nsw i64 %.279, -1
  %.13.i1 = tail call i64 @llvm.smin.i64(i64 %.280, i64 %.277)
  store i64 %.13.i1, ptr %.228, align 8
  br label %B686
}


define ptr @store_nodes(ptr readonly %.1, i64 %.2) local_unnamed_addr #0 {
entry:
  %.4 = alloca ptr, align 8
  store ptr null, ptr %.4, align 8
  %.8 = call i32 @_ZN18biped_adrc_kernels11store_nodesB4v106B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax(ptr nonnull %.4, ptr nonnull poison, ptr %.1, i64 %.2) #0
  %.18 = load ptr, ptr %.4, align 8
  ret ptr %.18
}


define i32 @_ZN18biped_adrc_kernels7set_endB4v108B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axx10float64_2a10float64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr readonly %arg.s, i64 %arg.j, i64 %arg.count, ptr readonly %arg.t0, ptr readonly %arg.t_next) local_unnamed_addr #0 {
B0.endif.endif:
  %.359 = alloca [4 x double], align 8
  %excinfo.5 = alloca ptr, align 8
  %.20 = getelementptr i8, ptr %arg.s, i64 600
  %.21 = load i64, ptr %.20, align 8
  %.22 = inttoptr i64 %.21 to ptr
  %.7.i = getelementptr i8, ptr %arg.s, i64 584
  %.8.i = load i64, ptr %.7.i, align 8, !noalias !313
  %.9.i = inttoptr i64 %.8.i to ptr
  %.10.i = getelementptr i8, ptr %.9.i, i64 96
  %.11.i = load i64, ptr %.10.i, align 8, !noalias !313
  %.12.i = getelementptr i8, ptr %arg.s, i64 568
  %.13.i = load i64, ptr %.12.i, align 8, !noalias !313
  %.14.i = mul i64 %.13.i, %.11.i
  %.15.i = getelementptr double, ptr %.22, i64 %.14.i
  %.144101.not = icmp slt i64 %.13.i, 1
  br i1 %.144101.not, label %common.ret, label %B116.lr.ph

B116:
  %.15097102 = phi i64 [ 0, %B116.lr.ph ], [ %.157, %B688 ]
  %.157 = add nuw nsw i64 %.15097102, 1
  %0 = shl i64 %.15097102, 3
  br i1 %1, label %B130, label %B168

B130:
  %scevgep38 = getelementptr i8, ptr %arg.t0, i64 %0
  %.192 = load double, ptr %scevgep38, align 8
  %.196 = load double, ptr %sunkaddr, align 8
  %.199 = fmul double %.196, %.198
  %.200 = fadd double %.192, %.199
  br label %B182.endif

B168:
  %scevgep29 = getelementptr i8, ptr %arg.t_next, i64 %0
  %.208 = load double, ptr %scevgep29, align 8
  br label %B182.endif

B256:
  %scevgep30 = getelementptr i8, ptr %arg.t_next, i64 %0
  %.259 = load double, ptr %scevgep30, align 8
  %.15.i16 = tail call double @nextafter(double %.259, double 0xFFF0000000000000), !noalias !316
  br label %B320.endif

B390:
  %.331 = load i64, ptr %sunkaddr39, align 8
  %.332 = inttoptr i64 %.331 to ptr
  %scevgep33 = getelementptr i8, ptr %.332, i64 %0
  %.335 = load i64, ptr %scevgep33, align 8
  %.336.not = icmp eq i64 %.335, 0
  br i1 %.336.not, label %B688, label %B424

B424:
  %.346 = inttoptr i64 %.335 to ptr
  %.347 = getelementptr i8, ptr %.346, i64 256
  %.349 = load double, ptr %.347, align 8
  %scevgep32 = getelementptr i8, ptr %.22, i64 %0
  %.353 = load double, ptr %scevgep32, align 8
  %.355 = fsub double %"$phi182.1.2.1", %.353
  %.358 = fmul double %.349, %.355
  %.363 = call i32 @_ZN18biped_adrc_kernels10relaxationB3v21B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAEd(ptr nonnull %.359, ptr nonnull %excinfo.5, double %.358)
  switch i32 %.363, label %common.ret [
    i32 -2, label %B424.endif
    i32 0, label %B424.endif
  ], !prof !8

B688:
  %exitcond.not = icmp eq i64 %.13.i, %.157
  br i1 %exitcond.not, label %common.ret, label %B116

common.ret:
  %excinfo.sink = phi ptr [ %retptr, %B0.endif.endif ], [ %retptr, %B688 ], [ %excinfo, %B424 ]
  %common.ret.op = phi i32 [ 0, %B0.endif.endif ], [ 0, %B688 ], [ %.363, %B424 ]
  store ptr null, ptr %excinfo.sink, align 8
  ret i32 %common.ret.op

B116.lr.ph:
  %.198 = sitofp i64 %arg.j to double
  %1 = icmp slt i64 %arg.j, %arg.count
  %sunkaddr42 = getelementptr i8, ptr %arg.s, i64 216
  %sunkaddr45 = getelementptr i8, ptr %arg.s, i64 160
  %sunkaddr = getelementptr i8, ptr %arg.s, i64 248
  %sunkaddr39 = getelementptr i8, ptr %arg.s, i64 616
  %sunkaddr46 = getelementptr inbounds nuw i8, ptr %.359, i64 24
  %sunkaddr47 = getelementptr inbounds nuw i8, ptr %.359, i64 16
  %sunkaddr48 = getelementptr inbounds nuw i8, ptr %.359, i64 8
  br label %B116

B182.endif:
  %"$phi182.1.2.1" = phi double [ %.208, %B168 ], [ %.200, %B130 ]
  %.8.i8 = load i64, ptr %.7.i, align 8, !noalias !319
  %.9.i9 = inttoptr i64 %.8.i8 to ptr
  %.10.i10 = getelementptr i8, ptr %.9.i9, i64 16
  %.11.i11 = load i64, ptr %.10.i10, align 8, !noalias !319
  %.13.i13 = load i64, ptr %.12.i, align 8, !noalias !319
  %2 = shl i64 %.11.i11, 3
  %3 = mul i64 %2, %.13.i13
  %scevgep36 = getelementptr i8, ptr %.22, i64 %3
  %scevgep37 = getelementptr i8, ptr %scevgep36, i64 %0
  store double %"$phi182.1.2.1", ptr %scevgep37, align 8
  %.252 = load double, ptr %sunkaddr42, align 8
  %.253 = fcmp ogt double %.252, 0.000000e+00
  br i1 %.253, label %B256, label %B320.endif

B320.endif:
  %"$phi320.1.2.1" = phi double [ 0x7FF0000000000000, %B182.endif ], [ %.15.i16, %B256 ]
  %.8.i18 = load i64, ptr %.7.i, align 8, !noalias !322
  %.9.i19 = inttoptr i64 %.8.i18 to ptr
  %.10.i20 = getelementptr i8, ptr %.9.i19, i64 24
  %.11.i21 = load i64, ptr %.10.i20, align 8, !noalias !322
  %.13.i23 = load i64, ptr %.12.i, align 8, !noalias !322
  %4 = shl i64 %.11.i21, 3
  %5 = mul i64 %4, %.13.i23
  %scevgep34 = getelementptr i8, ptr %.22, i64 %5
  %scevgep35 = getelementptr i8, ptr %scevgep34, i64 %0
  store double %"$phi320.1.2.1", ptr %scevgep35, align 8
  %.326 = load i64, ptr %sunkaddr45, align 8
  %.327 = icmp sgt i64 %.326, 0
  br i1 %.327, label %B390, label %B688

B424.endif:
  %.373.fca.3.load = load double, ptr %sunkaddr46, align 8
  %.373.fca.2.load = load double, ptr %sunkaddr47, align 8
  %.373.fca.1.load = load double, ptr %sunkaddr48, align 8
  %.373.fca.0.load = load double, ptr %.359, align 8
  %scevgep31 = getelementptr i8, ptr %.15.i, i64 %0
  store double %.373.fca.0.load, ptr %scevgep31, align 8
  %.391 = load i64, ptr %.12.i, align 8
  %6 = shl i64 %.391, 3
  %scevgep27 = getelementptr i8, ptr %.15.i, i64 %6
  %scevgep28 = getelementptr i8, ptr %scevgep27, i64 %0
  store double %.373.fca.1.load, ptr %scevgep28, align 8
  %.405 = load i64, ptr %.12.i, align 8
  %.idx = shl i64 %.405, 4
  %7 = getelementptr i8, ptr %.15.i, i64 %.idx
  %scevgep26 = getelementptr i8, ptr %7, i64 %0
  store double %.373.fca.2.load, ptr %scevgep26, align 8
  %.414 = load i64, ptr %.12.i, align 8
  %.idx88 = mul i64 %.414, 24
  %8 = getelementptr i8, ptr %.15.i, i64 %.idx88
  %scevgep = getelementptr i8, ptr %8, i64 %0
  store double %.373.fca.3.load, ptr %scevgep, align 8
  br label %B688
}


define ptr @set_end(ptr readonly %.1, i64 %.2, i64 %.3, ptr readonly %.4, ptr readonly %.5) local_unnamed_addr #0 {
entry:
  %.7 = alloca ptr, align 8
  store ptr null, ptr %.7, align 8
  %excinfo = alloca ptr, align 8
  %.11 = call i32 @_ZN18biped_adrc_kernels7set_endB4v108B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axx10float64_2a10float64_2a(ptr nonnull %.7, ptr nonnull %excinfo, ptr %.1, i64 %.2, i64 %.3, ptr %.4, ptr %.5) #0
  %cond = icmp eq i32 %.11, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.21 = load ptr, ptr %.7, align 8
  ret ptr %.21
}

define i32 @_ZN18biped_adrc_kernels10take_stepsB4v112B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a10float64_2axx(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr readonly %arg.s, ptr readonly %arg.t0, i64 %arg.until, i64 %arg.count) local_unnamed_addr {
B0.endif.endif:
  %.4.i = alloca ptr, align 8
  %.229 = alloca ptr, align 8
  %excinfo.3 = alloca ptr, align 8
  %.354 = alloca ptr, align 8
  %excinfo.6 = alloca ptr, align 8
  %.416 = alloca ptr, align 8
  %excinfo.8 = alloca ptr, align 8
  %.521 = alloca ptr, align 8
  %excinfo.11 = alloca ptr, align 8
  %.16 = getelementptr i8, ptr %arg.s, i64 600
  %.17 = load i64, ptr %.16, align 8
  %.18 = inttoptr i64 %.17 to ptr
  %.7.i = getelementptr i8, ptr %arg.s, i64 584
  %.8.i = load i64, ptr %.7.i, align 8, !noalias !325
  %.9.i = inttoptr i64 %.8.i to ptr
  %.10.i = getelementptr i64, ptr %.9.i, i64 %arg.until
  %.11.i = load i64, ptr %.10.i, align 8, !noalias !325
  %.12.i = getelementptr i8, ptr %arg.s, i64 568
  %.13.i = load i64, ptr %.12.i, align 8, !noalias !325
  %.14.i = mul nsw i64 %.13.i, %.11.i
  %.15.i = getelementptr double, ptr %.18, i64 %.14.i
  %.131117.not = icmp slt i64 %arg.count, 1
  br i1 %.131117.not, label %common.ret, label %B90.endif.preheader

B90.endif.preheader:
  %sunkaddr126 = getelementptr i8, ptr %arg.s, i64 24
  %sunkaddr127 = getelementptr i8, ptr %arg.s, i64 272
  %sunkaddr124 = getelementptr i8, ptr %arg.s, i64 64
  %sunkaddr125 = getelementptr i8, ptr %arg.s, i64 208
  %sunkaddr134 = getelementptr i8, ptr %arg.s, i64 72
  %sunkaddr138 = getelementptr i8, ptr %arg.s, i64 576
  %sunkaddr139 = getelementptr i8, ptr %arg.s, i64 312
  br label %B90.endif

B322:
  %.258 = load i64, ptr %arg.s, align 8
  %.261 = load i64, ptr %sunkaddr127, align 8
  %.262 = inttoptr i64 %.261 to ptr
  %.265 = load i64, ptr %.16, align 8
  %.266 = inttoptr i64 %.265 to ptr
  %.271 = inttoptr i64 %.258 to ptr
  tail call void %.271(ptr %.262, ptr %.266, ptr %.266)
  br label %B1021.sink.split

B442:
  %.278 = load i64, ptr %sunkaddr124, align 8
  %.279.not = icmp eq i64 %.278, 0
  br i1 %.279.not, label %B1021, label %B466

B466:
  %.283 = load i64, ptr %sunkaddr125, align 8
  %.284.not = icmp eq i64 %.283, 0
  br i1 %.284.not, label %B1021, label %B490.endif.endif

common.ret:
  %excinfo.sink = phi ptr [ %retptr, %B0.endif.endif ], [ %excinfo, %B490.endif.endif.endif.endif ], [ %excinfo, %B490.endif.endif ], [ %excinfo, %B90.endif ], [ %retptr, %B1021 ], [ %excinfo, %B490.endif.endif.endif.endif.endif.endif.endif ]
  %common.ret.op = phi i32 [ 0, %B0.endif.endif ], [ %.420, %B490.endif.endif.endif.endif ], [ %.358, %B490.endif.endif ], [ %.233, %B90.endif ], [ 0, %B1021 ], [ %.525, %B490.endif.endif.endif.endif.endif.endif.endif ]
  store ptr null, ptr %excinfo.sink, align 8
  ret i32 %common.ret.op

B1021.sink.split:
  %.8.i1 = call i32 @_ZN18biped_adrc_kernels11store_nodesB4v106B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax(ptr nonnull %.4.i, ptr nonnull poison, ptr nonnull readonly %arg.s, i64 14) #0
  br label %B1021

B1021:
  %exitcond = icmp eq i64 %.137107118, %arg.count
  br i1 %exitcond, label %common.ret, label %B90.endif

B90.endif:
  %.137107118 = phi i64 [ %.144, %B1021 ], [ 1, %B90.endif.preheader ]
  %.144 = add nuw i64 %.137107118, 1
  %.173 = tail call ptr @set_end(ptr nonnull %arg.s, i64 %.137107118, i64 %arg.count, ptr %arg.t0, ptr %.15.i)
  %.176 = load i64, ptr %sunkaddr126, align 8
  %.179 = load i64, ptr %sunkaddr127, align 8
  %.180 = inttoptr i64 %.179 to ptr
  %.183 = load i64, ptr %.16, align 8
  %.184 = inttoptr i64 %.183 to ptr
  %.189 = inttoptr i64 %.176 to ptr
  tail call void %.189(ptr %.180, ptr %.184, ptr %.184)
  %.195 = load i64, ptr %.16, align 8
  %.196 = inttoptr i64 %.195 to ptr
  %.8.i49 = load i64, ptr %.7.i, align 8, !noalias !328
  %.9.i50 = inttoptr i64 %.8.i49 to ptr
  %.10.i51 = getelementptr i8, ptr %.9.i50, i64 16
  %.11.i52 = load i64, ptr %.10.i51, align 8, !noalias !328
  %.13.i54 = load i64, ptr %.12.i, align 8, !noalias !328
  %.14.i55 = mul nsw i64 %.13.i54, %.11.i52
  %.15.i56 = getelementptr double, ptr %.196, i64 %.14.i55
  %.233 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.229, ptr nonnull %excinfo.3, ptr %.15.i56, ptr %.196, i64 %.13.i54)
  switch i32 %.233, label %common.ret [
    i32 -2, label %B90.endif.endif
    i32 0, label %B90.endif.endif
  ], !prof !8

B90.endif.endif:
  %.254 = icmp slt i64 %.137107118, %arg.count
  br i1 %.254, label %B322, label %B442

B490.endif.endif:
  %.290 = load i64, ptr %.16, align 8
  %.291 = inttoptr i64 %.290 to ptr
  %.8.i58 = load i64, ptr %.7.i, align 8, !noalias !331
  %.9.i59 = inttoptr i64 %.8.i58 to ptr
  %.10.i60 = getelementptr i8, ptr %.9.i59, i64 112
  %.11.i61 = load i64, ptr %.10.i60, align 8, !noalias !331
  %.13.i63 = load i64, ptr %.12.i, align 8, !noalias !331
  %.14.i64 = mul nsw i64 %.13.i63, %.11.i61
  %.15.i65 = getelementptr double, ptr %.291, i64 %.14.i64
  %.10.i69 = getelementptr i8, ptr %.9.i59, i64 8
  %.11.i70 = load i64, ptr %.10.i69, align 8, !noalias !334
  %.14.i73 = mul nsw i64 %.11.i70, %.13.i63
  %.15.i74 = getelementptr double, ptr %.291, i64 %.14.i73
  %.349 = load i64, ptr %sunkaddr134, align 8
  %.353 = mul nsw i64 %.349, %.13.i63
  %.358 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.354, ptr nonnull %excinfo.6, ptr %.15.i65, ptr %.15.i74, i64 %.353)
  switch i32 %.358, label %common.ret [
    i32 -2, label %B490.endif.endif.endif.endif
    i32 0, label %B490.endif.endif.endif.endif
  ], !prof !8

B490.endif.endif.endif.endif:
  %.382 = load i64, ptr %.16, align 8
  %.383 = inttoptr i64 %.382 to ptr
  %.8.i76 = load i64, ptr %.7.i, align 8, !noalias !337
  %.9.i77 = inttoptr i64 %.8.i76 to ptr
  %.10.i78 = getelementptr i8, ptr %.9.i77, i64 24
  %.11.i79 = load i64, ptr %.10.i78, align 8, !noalias !337
  %.13.i81 = load i64, ptr %.12.i, align 8, !noalias !337
  %.14.i82 = mul nsw i64 %.13.i81, %.11.i79
  %.15.i83 = getelementptr double, ptr %.383, i64 %.14.i82
  %.420 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.416, ptr nonnull %excinfo.8, ptr %.15.i83, ptr %.383, i64 %.13.i81)
  switch i32 %.420, label %common.ret [
    i32 -2, label %B490.endif.endif.endif.endif.endif.endif.endif
    i32 0, label %B490.endif.endif.endif.endif.endif.endif.endif
  ], !prof !8

B490.endif.endif.endif.endif.endif.endif.endif:
  %.442 = load i64, ptr %sunkaddr138, align 8
  %.445 = load i64, ptr %sunkaddr139, align 8
  %.449 = load i64, ptr %.16, align 8
  %.450 = inttoptr i64 %.449 to ptr
  %.8.i85 = load i64, ptr %.7.i, align 8, !noalias !340
  %.9.i86 = inttoptr i64 %.8.i85 to ptr
  %.10.i87 = getelementptr i8, ptr %.9.i86, i64 112
  %.11.i88 = load i64, ptr %.10.i87, align 8, !noalias !340
  %.13.i90 = load i64, ptr %.12.i, align 8, !noalias !340
  %.14.i91 = mul nsw i64 %.13.i90, %.11.i88
  %.15.i92 = getelementptr double, ptr %.450, i64 %.14.i91
  %.446 = inttoptr i64 %.445 to ptr
  %.481 = inttoptr i64 %.442 to ptr
  tail call void %.481(ptr %.446, ptr %.450, ptr %.15.i92)
  %.487 = load i64, ptr %.16, align 8
  %.488 = inttoptr i64 %.487 to ptr
  %.8.i94 = load i64, ptr %.7.i, align 8, !noalias !343
  %.9.i95 = inttoptr i64 %.8.i94 to ptr
  %.10.i96 = getelementptr i8, ptr %.9.i95, i64 16
  %.11.i97 = load i64, ptr %.10.i96, align 8, !noalias !343
  %.13.i99 = load i64, ptr %.12.i, align 8, !noalias !343
  %.14.i100 = mul nsw i64 %.13.i99, %.11.i97
  %.15.i101 = getelementptr double, ptr %.488, i64 %.14.i100
  %.525 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.521, ptr nonnull %excinfo.11, ptr %.15.i101, ptr %.488, i64 %.13.i99)
  switch i32 %.525, label %common.ret [
    i32 -2, label %B1021.sink.split
    i32 0, label %B1021.sink.split
  ], !prof !8
}


define ptr @take_steps(ptr readonly %.1, ptr readonly %.2, i64 %.3, i64 %.4) local_unnamed_addr #0 {
entry:
  %.6 = alloca ptr, align 8
  store ptr null, ptr %.6, align 8
  %excinfo = alloca ptr, align 8
  %.10 = call i32 @_ZN18biped_adrc_kernels10take_stepsB4v112B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a10float64_2axx(ptr nonnull %.6, ptr nonnull %excinfo, ptr %.1, ptr %.2, i64 %.3, i64 %.4) #0
  %cond = icmp eq i32 %.10, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.20 = load ptr, ptr %.6, align 8
  ret ptr %.20
}

define i32 @_ZN18biped_adrc_kernels10sample_allB4v114B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr readonly %arg.s) local_unnamed_addr {
B0:
  %.4.i3 = alloca ptr, align 8
  %.4.i = alloca ptr, align 8
  %.32 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.245 = alloca ptr, align 8
  %excinfo.5 = alloca ptr, align 8
  %.8 = getelementptr i8, ptr %arg.s, i64 216
  %.10 = load double, ptr %.8, align 8
  %.11 = fcmp oeq double %.10, 0.000000e+00
  br i1 %.11, label %B26, label %B264

B26:
  %.15 = getelementptr i8, ptr %arg.s, i64 592
  %.16 = load i64, ptr %.15, align 8
  %.17 = inttoptr i64 %.16 to ptr
  %.19 = getelementptr i8, ptr %arg.s, i64 600
  %.20 = load i64, ptr %.19, align 8
  %.21 = inttoptr i64 %.20 to ptr
  %.23 = getelementptr i8, ptr %arg.s, i64 584
  %.24 = load i64, ptr %.23, align 8
  %.25 = inttoptr i64 %.24 to ptr
  %.26 = getelementptr i8, ptr %.25, i64 120
  %.27 = load i64, ptr %.26, align 8
  %.29 = getelementptr i8, ptr %arg.s, i64 568
  %.30 = load i64, ptr %.29, align 8
  %.31 = mul nsw i64 %.30, %.27
  %.36 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.32, ptr nonnull %excinfo.1, ptr %.17, ptr %.21, i64 %.31)
  switch i32 %.36, label %common.ret [
    i32 -2, label %B26.endif
    i32 0, label %B26.endif
  ], !prof !8

B264:
  %.86 = getelementptr i8, ptr %arg.s, i64 8
  %.87 = load i64, ptr %.86, align 8
  %.89 = getelementptr i8, ptr %arg.s, i64 272
  %.90 = load i64, ptr %.89, align 8
  %.91 = inttoptr i64 %.90 to ptr
  %.93 = getelementptr i8, ptr %arg.s, i64 592
  %.94 = load i64, ptr %.93, align 8
  %.95 = inttoptr i64 %.94 to ptr
  %.97 = getelementptr i8, ptr %arg.s, i64 600
  %.98 = load i64, ptr %.97, align 8
  %.99 = inttoptr i64 %.98 to ptr
  %.100 = inttoptr i64 %.87 to ptr
  tail call void %.100(ptr %.91, ptr %.95, ptr %.99)
  %.8.i2 = call i32 @_ZN18biped_adrc_kernels11store_nodesB4v106B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax(ptr nonnull %.4.i, ptr nonnull poison, ptr nonnull readonly %arg.s, i64 1) #0
  %.105 = getelementptr i8, ptr %arg.s, i64 224
  %.107 = load double, ptr %.105, align 8
  %.108 = fcmp oeq double %.107, 0.000000e+00
  %.112 = load i64, ptr %.93, align 8
  br i1 %.108, label %B404.endif, label %B504.endif.endif

common.ret:
  %retptr.sink = phi ptr [ %retptr, %B504.endif.endif.endif.endif.endif.endif ], [ %excinfo, %B26 ], [ %retptr, %B404.endif ], [ %retptr, %B26.endif ], [ %excinfo, %B504.endif.endif ]
  %common.ret.op = phi i32 [ 0, %B504.endif.endif.endif.endif.endif.endif ], [ %.36, %B26 ], [ 0, %B404.endif ], [ 0, %B26.endif ], [ %.249, %B504.endif.endif ]
  store ptr null, ptr %retptr.sink, align 8
  ret i32 %common.ret.op

B26.endif:
  %.60 = load i64, ptr %.15, align 8
  %.61 = inttoptr i64 %.60 to ptr
  %.63 = tail call ptr @take_steps(ptr nonnull %arg.s, ptr %.61, i64 8, i64 1)
  %.66 = load i64, ptr %arg.s, align 8
  %.68 = getelementptr i8, ptr %arg.s, i64 272
  %.69 = load i64, ptr %.68, align 8
  %.70 = inttoptr i64 %.69 to ptr
  %.73 = load i64, ptr %.19, align 8
  %.74 = inttoptr i64 %.73 to ptr
  %.81 = inttoptr i64 %.66 to ptr
  tail call void %.81(ptr %.70, ptr %.74, ptr %.74)
  br label %common.ret

B404.endif:
  %.118 = load double, ptr %.8, align 8
  %.8.i = getelementptr i8, ptr %arg.s, i64 248
  %.10.i = load double, ptr %.8.i, align 8, !noalias !346
  %.14.i = fdiv double %.118, %.10.i
  %.15.i = fadd double %.14.i, -1.000000e-09
  %.23.le.i = tail call double @llvm.ceil.f64(double %.15.i)
  %.12.i.i = fcmp ogt double %.23.le.i, 1.000000e+00
  %.13.i.i = select i1 %.12.i.i, double %.23.le.i, double 1.000000e+00
  %.5.i.i = fptosi double %.13.i.i to i64
  %.113 = inttoptr i64 %.112 to ptr
  %.145 = tail call ptr @take_steps(ptr nonnull %arg.s, ptr %.113, i64 8, i64 %.5.i.i)
  br label %common.ret

B504.endif.endif:
  %.8.i1 = getelementptr i8, ptr %arg.s, i64 248
  %.10.i2 = load double, ptr %.8.i1, align 8, !noalias !349
  %.14.i3 = fdiv double %.107, %.10.i2
  %.15.i4 = fadd double %.14.i3, -1.000000e-09
  %.23.le.i5 = tail call double @llvm.ceil.f64(double %.15.i4)
  %.12.i.i6 = fcmp ogt double %.23.le.i5, 1.000000e+00
  %.13.i.i7 = select i1 %.12.i.i6, double %.23.le.i5, double 1.000000e+00
  %.5.i.i8 = fptosi double %.13.i.i7 to i64
  %.153 = inttoptr i64 %.112 to ptr
  %.185 = tail call ptr @take_steps(ptr nonnull %arg.s, ptr %.153, i64 7, i64 %.5.i.i8)
  %.189 = load i64, ptr %.97, align 8
  %.190 = inttoptr i64 %.189 to ptr
  %.7.i = getelementptr i8, ptr %arg.s, i64 584
  %.8.i9 = load i64, ptr %.7.i, align 8, !noalias !352
  %.9.i = inttoptr i64 %.8.i9 to ptr
  %.11.i = load i64, ptr %.9.i, align 8, !noalias !352
  %.12.i = getelementptr i8, ptr %arg.s, i64 568
  %.13.i = load i64, ptr %.12.i, align 8, !noalias !352
  %.14.i10 = mul nsw i64 %.13.i, %.11.i
  %.15.i11 = getelementptr double, ptr %.190, i64 %.14.i10
  %.217 = getelementptr i8, ptr %arg.s, i64 80
  %.218 = load i64, ptr %.217, align 8
  %.220 = getelementptr i8, ptr %arg.s, i64 88
  %.221 = load i64, ptr %.220, align 8
  %.222 = sub nsw i64 %.218, %.221
  %.226 = mul nsw i64 %.222, %.13.i
  %.227 = getelementptr double, ptr %.15.i11, i64 %.226
  %0 = mul i64 %.221, %.13.i
  %.236 = sub i64 0, %0
  %.237 = getelementptr double, ptr %.227, i64 %.236
  %.249 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.245, ptr nonnull %excinfo.5, ptr %.237, ptr %.227, i64 %0)
  switch i32 %.249, label %common.ret [
    i32 -2, label %B504.endif.endif.endif.endif.endif.endif
    i32 0, label %B504.endif.endif.endif.endif.endif.endif
  ], !prof !8

B504.endif.endif.endif.endif.endif.endif:
  %.271 = load i64, ptr %.93, align 8
  %.276 = load i64, ptr %.97, align 8
  %.277 = inttoptr i64 %.276 to ptr
  %.8.i13 = load i64, ptr %.7.i, align 8, !noalias !355
  %.9.i14 = inttoptr i64 %.8.i13 to ptr
  %.10.i15 = getelementptr i8, ptr %.9.i14, i64 64
  %.11.i16 = load i64, ptr %.10.i15, align 8, !noalias !355
  %.13.i18 = load i64, ptr %.12.i, align 8, !noalias !355
  %.14.i19 = mul nsw i64 %.13.i18, %.11.i16
  %.15.i20 = getelementptr double, ptr %.277, i64 %.14.i19
  %.272 = inttoptr i64 %.271 to ptr
  %.304 = tail call ptr @set_end(ptr nonnull %arg.s, i64 1, i64 1, ptr %.272, ptr %.15.i20)
  %.307 = load i64, ptr %arg.s, align 8
  %.310 = load i64, ptr %.89, align 8
  %.311 = inttoptr i64 %.310 to ptr
  %.314 = load i64, ptr %.97, align 8
  %.315 = inttoptr i64 %.314 to ptr
  %.320 = inttoptr i64 %.307 to ptr
  tail call void %.320(ptr %.311, ptr %.315, ptr %.315)
  %.8.i4 = call i32 @_ZN18biped_adrc_kernels11store_nodesB4v106B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax(ptr nonnull %.4.i3, ptr nonnull poison, ptr nonnull readonly %arg.s, i64 14) #0
  %.327 = load i64, ptr %.97, align 8
  %.328 = inttoptr i64 %.327 to ptr
  %.8.i22 = load i64, ptr %.7.i, align 8, !noalias !358
  %.9.i23 = inttoptr i64 %.8.i22 to ptr
  %.10.i24 = getelementptr i8, ptr %.9.i23, i64 56
  %.11.i25 = load i64, ptr %.10.i24, align 8, !noalias !358
  %.13.i27 = load i64, ptr %.12.i, align 8, !noalias !358
  %.14.i28 = mul nsw i64 %.13.i27, %.11.i25
  %.15.i29 = getelementptr double, ptr %.328, i64 %.14.i28
  %.358 = load double, ptr %.105, align 8
  %.362 = load double, ptr %.8, align 8
  %.7.i30 = fsub double %.362, %.358
  %.10.i32 = load double, ptr %.8.i1, align 8, !noalias !361
  %.14.i33 = fdiv double %.7.i30, %.10.i32
  %.15.i34 = fadd double %.14.i33, -1.000000e-09
  %.23.le.i35 = tail call double @llvm.ceil.f64(double %.15.i34)
  %.12.i.i36 = fcmp ogt double %.23.le.i35, 1.000000e+00
  %.13.i.i37 = select i1 %.12.i.i36, double %.23.le.i35, double 1.000000e+00
  %.5.i.i38 = fptosi double %.13.i.i37 to i64
  %.389 = tail call ptr @take_steps(ptr nonnull %arg.s, ptr %.15.i29, i64 8, i64 %.5.i.i38)
  br label %common.ret
}


define ptr @sample_all(ptr readonly %.1) local_unnamed_addr #0 {
entry:
  %.3 = alloca ptr, align 8
  store ptr null, ptr %.3, align 8
  %excinfo = alloca ptr, align 8
  %.7 = call i32 @_ZN18biped_adrc_kernels10sample_allB4v114B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3, ptr nonnull %excinfo, ptr %.1) #0
  %cond = icmp eq i32 %.7, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.17 = load ptr, ptr %.3, align 8
  ret ptr %.17
}


define i32 @_ZN18biped_adrc_kernels12side_by_sideB4v115B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a8int64_2ax8int64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr %arg.s, ptr readonly %arg.walks, i64 %arg.count, ptr writeonly %arg.codes) local_unnamed_addr #0 {
B0.endif:
  %.6.i12 = alloca ptr, align 8
  %.3.i9 = alloca i64, align 8
  %.5.i = alloca ptr, align 8
  %.3.i = alloca i64, align 8
  %.6.i5 = alloca ptr, align 8
  %.6.i2 = alloca ptr, align 8
  %.6.i = alloca ptr, align 8
  %.44 = getelementptr i8, ptr %arg.s, i64 568
  %.45 = load i64, ptr %.44, align 8
  %.127345.not = icmp slt i64 %.45, 1
  br i1 %.127345.not, label %B106.endif.preheader, label %B58.lr.ph

B58.lr.ph:
  %xtraiter = and i64 %.45, 7
  %0 = icmp samesign ult i64 %.45, 8
  br i1 %0, label %B58.epil.preheader, label %B58.lr.ph.new

B58.lr.ph.new:
  %unroll_iter = and i64 %.45, 9223372036854775800
  %sunkaddr109 = getelementptr i8, ptr %arg.s, i64 624
  %sunkaddr110 = getelementptr i8, ptr %arg.s, i64 616
  br label %B58

B106.endif.preheader.loopexit.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B106.endif.preheader, label %B58.epil.preheader

B58.epil.preheader:
  %.133344346.epil.init = phi i64 [ 0, %B58.lr.ph ], [ %unroll_iter, %B106.endif.preheader.loopexit.unr-lcssa ]
  %sunkaddr = getelementptr i8, ptr %arg.s, i64 624
  %sunkaddr108 = getelementptr i8, ptr %arg.s, i64 616
  br label %B58.epil

B58.epil:
  %lsr.iv = phi i64 [ %lsr.iv.next, %B58.epil ], [ %xtraiter, %B58.epil.preheader ]
  %.133344346.epil = phi i64 [ %.140.epil, %B58.epil ], [ %.133344346.epil.init, %B58.epil.preheader ]
  %.140.epil = add nuw nsw i64 %.133344346.epil, 1
  %.171.epil = load i64, ptr %sunkaddr, align 8
  %.172.epil = inttoptr i64 %.171.epil to ptr
  %1 = shl i64 %.133344346.epil, 3
  %scevgep77 = getelementptr i8, ptr %.172.epil, i64 %1
  store i64 -1, ptr %scevgep77, align 8
  %.177.epil = load i64, ptr %sunkaddr108, align 8
  %.178.epil = inttoptr i64 %.177.epil to ptr
  %scevgep = getelementptr i8, ptr %.178.epil, i64 %1
  store i64 0, ptr %scevgep, align 8
  %lsr.iv.next = add nsw i64 %lsr.iv, -1
  %epil.iter.cmp.not = icmp eq i64 %lsr.iv.next, 0
  br i1 %epil.iter.cmp.not, label %B106.endif.preheader, label %B58.epil, !llvm.loop !364

B106.endif.preheader:
  %sunkaddr111 = getelementptr i8, ptr %arg.s, i64 624
  %sunkaddr119 = getelementptr i8, ptr %arg.s, i64 600
  %sunkaddr120 = getelementptr i8, ptr %arg.s, i64 584
  %sunkaddr112 = getelementptr i8, ptr %arg.s, i64 592
  %sunkaddr115 = getelementptr i8, ptr %arg.s, i64 616
  br label %B106.endif

B58:
  %.133344346 = phi i64 [ 0, %B58.lr.ph.new ], [ %.140.7, %B58 ]
  %.171 = load i64, ptr %sunkaddr109, align 8
  %.172 = inttoptr i64 %.171 to ptr
  %2 = shl i64 %.133344346, 3
  %scevgep107 = getelementptr i8, ptr %.172, i64 %2
  store i64 -1, ptr %scevgep107, align 8
  %.177 = load i64, ptr %sunkaddr110, align 8
  %.178 = inttoptr i64 %.177 to ptr
  %scevgep106 = getelementptr i8, ptr %.178, i64 %2
  store i64 0, ptr %scevgep106, align 8
  %.171.1 = load i64, ptr %sunkaddr109, align 8
  %.172.1 = inttoptr i64 %.171.1 to ptr
  %scevgep102 = getelementptr i8, ptr %.172.1, i64 8
  %scevgep103 = getelementptr i8, ptr %scevgep102, i64 %2
  store i64 -1, ptr %scevgep103, align 8
  %.177.1 = load i64, ptr %sunkaddr110, align 8
  %.178.1 = inttoptr i64 %.177.1 to ptr
  %scevgep104 = getelementptr i8, ptr %.178.1, i64 8
  %scevgep105 = getelementptr i8, ptr %scevgep104, i64 %2
  store i64 0, ptr %scevgep105, align 8
  %.171.2 = load i64, ptr %sunkaddr109, align 8
  %.172.2 = inttoptr i64 %.171.2 to ptr
  %scevgep98 = getelementptr i8, ptr %.172.2, i64 16
  %scevgep99 = getelementptr i8, ptr %scevgep98, i64 %2
  store i64 -1, ptr %scevgep99, align 8
  %.177.2 = load i64, ptr %sunkaddr110, align 8
  %.178.2 = inttoptr i64 %.177.2 to ptr
  %scevgep100 = getelementptr i8, ptr %.178.2, i64 16
  %scevgep101 = getelementptr i8, ptr %scevgep100, i64 %2
  store i64 0, ptr %scevgep101, align 8
  %.171.3 = load i64, ptr %sunkaddr109, align 8
  %.172.3 = inttoptr i64 %.171.3 to ptr
  %scevgep94 = getelementptr i8, ptr %.172.3, i64 24
  %scevgep95 = getelementptr i8, ptr %scevgep94, i64 %2
  store i64 -1, ptr %scevgep95, align 8
  %.177.3 = load i64, ptr %sunkaddr110, align 8
  %.178.3 = inttoptr i64 %.177.3 to ptr
  %scevgep96 = getelementptr i8, ptr %.178.3, i64 24
  %scevgep97 = getelementptr i8, ptr %scevgep96, i64 %2
  store i64 0, ptr %scevgep97, align 8
  %.171.4 = load i64, ptr %sunkaddr109, align 8
  %.172.4 = inttoptr i64 %.171.4 to ptr
  %scevgep90 = getelementptr i8, ptr %.172.4, i64 32
  %scevgep91 = getelementptr i8, ptr %scevgep90, i64 %2
  store i64 -1, ptr %scevgep91, align 8
  %.177.4 = load i64, ptr %sunkaddr110, align 8
  %.178.4 = inttoptr i64 %.177.4 to ptr
  %scevgep92 = getelementptr i8, ptr %.178.4, i64 32
  %scevgep93 = getelementptr i8, ptr %scevgep92, i64 %2
  store i64 0, ptr %scevgep93, align 8
  %.171.5 = load i64, ptr %sunkaddr109, align 8
  %.172.5 = inttoptr i64 %.171.5 to ptr
  %scevgep86 = getelementptr i8, ptr %.172.5, i64 40
  %scevgep87 = getelementptr i8, ptr %scevgep86, i64 %2
  store i64 -1, ptr %scevgep87, align 8
  %.177.5 = load i64, ptr %sunkaddr110, align 8
  %.178.5 = inttoptr i64 %.177.5 to ptr
  %scevgep88 = getelementptr i8, ptr %.178.5, i64 40
  %scevgep89 = getelementptr i8, ptr %scevgep88, i64 %2
  store i64 0, ptr %scevgep89, align 8
  %.171.6 = load i64, ptr %sunkaddr109, align 8
  %.172.6 = inttoptr i64 %.171.6 to ptr
  %scevgep82 = getelementptr i8, ptr %.172.6, i64 48
  %scevgep83 = getelementptr i8, ptr %scevgep82, i64 %2
  store i64 -1, ptr %scevgep83, align 8
  %.177.6 = load i64, ptr %sunkaddr110, align 8
  %.178.6 = inttoptr i64 %.177.6 to ptr
  %scevgep84 = getelementptr i8, ptr %.178.6, i64 48
  %scevgep85 = getelementptr i8, ptr %scevgep84, i64 %2
  store i64 0, ptr %scevgep85, align 8
  %.140.7 = add nuw nsw i64 %.133344346, 8
  %.171.7 = load i64, ptr %sunkaddr109, align 8
  %.172.7 = inttoptr i64 %.171.7 to ptr
  %scevgep78 = getelementptr i8, ptr %.172.7, i64 56
  %scevgep79 = getelementptr i8, ptr %scevgep78, i64 %2
  store i64 -1, ptr %scevgep79, align 8
  %.177.7 = load i64, ptr %sunkaddr110, align 8
  %.178.7 = inttoptr i64 %.177.7 to ptr
  %scevgep80 = getelementptr i8, ptr %.178.7, i64 56
  %scevgep81 = getelementptr i8, ptr %scevgep80, i64 %2
  store i64 0, ptr %scevgep81, align 8
  %niter.ncmp.7 = icmp eq i64 %unroll_iter, %.140.7
  br i1 %niter.ncmp.7, label %B106.endif.preheader.loopexit.unr-lcssa, label %B58

B150:
  %busy.4.1359 = phi i64 [ %busy.6.2, %B1223 ], [ %busy.5.0, %B106.endif ]
  %waiting.2.1358 = phi i64 [ %waiting.4.2, %B1223 ], [ %waiting.3.0, %B106.endif ]
  %.306351354 = phi i64 [ %.313, %B1223 ], [ 0, %B106.endif ]
  %.313 = add nuw nsw i64 %.306351354, 1
  %.343 = load i64, ptr %sunkaddr111, align 8
  %.344 = inttoptr i64 %.343 to ptr
  %.346 = getelementptr i64, ptr %.344, i64 %.306351354
  %.347 = load i64, ptr %.346, align 8
  %.366 = icmp sgt i64 %.347, -1
  br i1 %.366, label %B246.endif, label %B720

B512:
  %.10.i1 = call i32 @_ZN18biped_adrc_kernels12begin_sampleB3v98B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a(ptr nonnull %.6.i, ptr nonnull poison, ptr nonnull readonly %arg.s, i64 %.306351354, ptr nonnull %3, ptr %4) #0
  br label %B1223

B560:
  %.10.i3 = call i32 @_ZN18biped_adrc_kernels5leaveB3v93B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a(ptr nonnull %.6.i2, ptr nonnull poison, ptr nonnull readonly %arg.s, i64 %.306351354, ptr nonnull readonly %3, ptr readonly %4) #0
  br label %B732.preheader

B608:
  %.522 = load i64, ptr %sunkaddr112, align 8
  %.523 = inttoptr i64 %.522 to ptr
  %.10.i6 = call i32 @_ZN18biped_adrc_kernels5leaveB3v93B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a(ptr nonnull %.6.i5, ptr nonnull poison, ptr nonnull readonly %arg.s, i64 %.306351354, ptr readonly %3, ptr readonly %.523) #0
  %.529 = getelementptr i8, ptr %3, i64 440
  %.530 = load i64, ptr %.529, align 8
  %.532 = getelementptr i8, ptr %3, i64 408
  store i64 %.530, ptr %.532, align 8
  store i64 0, ptr %.3.i, align 8
  %.7.i = call i32 @_ZN18biped_adrc_kernels10move_aloneB3v83B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3.i, ptr nonnull poison, ptr %3) #0
  %.17.i = load i64, ptr %.3.i, align 8
  br label %B732.preheader

B720:
  %.350 = load i64, ptr %arg.walks, align 8
  %.351 = inttoptr i64 %.350 to ptr
  %.603 = icmp slt i64 %waiting.2.1358, %arg.count
  br i1 %.603, label %B732.preheader, label %B1164

B732.preheader:
  %r.4.3.ph = phi ptr [ %3, %B560 ], [ %3, %B608 ], [ %.351, %B720 ]
  %code.5.3.ph = phi i64 [ -1, %B560 ], [ %.17.i, %B608 ], [ -1, %B720 ]
  br label %B732

B732:
  %waiting.7.3 = phi i64 [ %waiting.6.5268, %B1120 ], [ %waiting.2.1358, %B732.preheader ]
  %busy.3.3 = phi i64 [ %.778, %B1120 ], [ %busy.4.1359, %B732.preheader ]
  %r.4.3 = phi ptr [ %r.3.5273, %B1120 ], [ %r.4.3.ph, %B732.preheader ]
  %code.5.3 = phi i64 [ %code.7.5, %B1120 ], [ %code.5.3.ph, %B732.preheader ]
  %i.3.3 = phi i64 [ -1, %B1120 ], [ %.347, %B732.preheader ]
  %.648 = icmp slt i64 %i.3.3, 0
  br i1 %.648, label %B864.thread, label %B864

B864.thread:
  %.653 = add nsw i64 %waiting.7.3, 1
  %.655 = add nsw i64 %busy.3.3, 1
  %.678 = getelementptr i64, ptr %arg.walks, i64 %waiting.7.3
  %.679 = load i64, ptr %.678, align 8
  %.680 = inttoptr i64 %.679 to ptr
  %.9.i8 = call i32 @_ZN18biped_adrc_kernels11put_numbersB3v92B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a(ptr nonnull %.5.i, ptr nonnull poison, ptr readonly %arg.s, i64 %.306351354, ptr readonly %.680) #0
  br label %B886

B864:
  %.696 = icmp eq i64 %code.5.3, -1
  br i1 %.696, label %B886, label %B1120

B886:
  %i.4.5276 = phi i64 [ %waiting.7.3, %B864.thread ], [ %i.3.3, %B864 ]
  %r.3.5272 = phi ptr [ %.680, %B864.thread ], [ %r.4.3, %B864 ]
  %busy.8.5271 = phi i64 [ %.655, %B864.thread ], [ %busy.3.3, %B864 ]
  %waiting.6.5269 = phi i64 [ %.653, %B864.thread ], [ %waiting.7.3, %B864 ]
  %.704 = tail call i64 @is_plain(ptr %r.3.5272)
  %.705 = icmp eq i64 %.704, 0
  br i1 %.705, label %B924, label %B1132

B924:
  store i64 0, ptr %.3.i9, align 8
  %.7.i10 = call i32 @_ZN18biped_adrc_kernels10move_aloneB3v83B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3.i9, ptr nonnull poison, ptr %r.3.5272) #0
  %.17.i11 = load i64, ptr %.3.i9, align 8
  %.719 = icmp eq i64 %.17.i11, -1
  br i1 %.719, label %B976, label %B1120

B976:
  %.727 = tail call i64 @is_plain(ptr %r.3.5272)
  %.728 = icmp eq i64 %.727, 0
  br i1 %.728, label %B924, label %B1132

B1120:
  %i.4.5275 = phi i64 [ %i.3.3, %B864 ], [ %i.4.5276, %B924 ]
  %r.3.5273 = phi ptr [ %r.4.3, %B864 ], [ %r.3.5272, %B924 ]
  %busy.8.5270 = phi i64 [ %busy.3.3, %B864 ], [ %busy.8.5271, %B924 ]
  %waiting.6.5268 = phi i64 [ %waiting.7.3, %B864 ], [ %waiting.6.5269, %B924 ]
  %code.7.5 = phi i64 [ %code.5.3, %B864 ], [ %.17.i11, %B924 ]
  %.773 = getelementptr i64, ptr %arg.codes, i64 %i.4.5275
  store i64 %code.7.5, ptr %.773, align 8
  %.778 = add nsw i64 %busy.8.5270, -1
  %.799 = icmp slt i64 %waiting.6.5268, %arg.count
  br i1 %.799, label %B732, label %B1164

B1132:
  %.761 = load i64, ptr %sunkaddr119, align 8
  %.762 = inttoptr i64 %.761 to ptr
  %.10.i13 = call i32 @_ZN18biped_adrc_kernels5enterB4v102B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a(ptr nonnull %.6.i12, ptr nonnull poison, ptr readonly %arg.s, i64 %.306351354, ptr %r.3.5272, ptr %.762) #0
  %.822 = icmp sgt i64 %i.4.5276, -1
  br i1 %.822, label %B1146, label %B1164

B1146:
  %.830 = getelementptr i64, ptr %arg.walks, i64 %i.4.5276
  %.831 = load i64, ptr %.830, align 8
  br label %B1164

B1164:
  %i.5.4303 = phi i64 [ %i.4.5276, %B1146 ], [ %i.4.5276, %B1132 ], [ %.347, %B720 ], [ -1, %B1120 ]
  %busy.7.4301 = phi i64 [ %busy.8.5271, %B1146 ], [ %busy.8.5271, %B1132 ], [ %busy.4.1359, %B720 ], [ %.778, %B1120 ]
  %waiting.5.4299 = phi i64 [ %waiting.6.5269, %B1146 ], [ %waiting.6.5269, %B1132 ], [ %waiting.2.1358, %B720 ], [ %waiting.6.5268, %B1120 ]
  %"$phi1164.2.2.3" = phi i64 [ %.831, %B1146 ], [ 0, %B1132 ], [ 0, %B720 ], [ 0, %B1120 ]
  %.855 = load i64, ptr %sunkaddr111, align 8
  %.856 = inttoptr i64 %.855 to ptr
  %.859 = getelementptr i64, ptr %.856, i64 %.306351354
  store i64 %i.5.4303, ptr %.859, align 8
  %.865 = load i64, ptr %sunkaddr115, align 8
  %.866 = inttoptr i64 %.865 to ptr
  %.869 = getelementptr i64, ptr %.866, i64 %.306351354
  store i64 %"$phi1164.2.2.3", ptr %.869, align 8
  br label %B1223

B1206:
  %waiting.2.1.lcssa = phi i64 [ %waiting.3.0, %B106.endif ], [ %waiting.4.2, %B1223 ]
  %busy.4.1.lcssa = phi i64 [ %busy.5.0, %B106.endif ], [ %busy.6.2, %B1223 ]
  %.881 = icmp eq i64 %busy.4.1.lcssa, 0
  br i1 %.881, label %common.ret, label %B1222

common.ret:
  store i64 %samples.2.0, ptr %retptr, align 8
  ret i32 0

B1222:
  %.912 = load i64, ptr %sunkaddr119, align 8
  %.916 = load i64, ptr %sunkaddr112, align 8
  store i64 %.912, ptr %sunkaddr112, align 8
  store i64 %.916, ptr %sunkaddr119, align 8
  %.927 = tail call ptr @sample_all(ptr nonnull %arg.s)
  %.929 = add nuw nsw i64 %samples.2.0, 1
  br label %B106.endif

B1223:
  %waiting.4.2 = phi i64 [ %waiting.2.1358, %B512 ], [ %waiting.5.4299, %B1164 ]
  %busy.6.2 = phi i64 [ %busy.4.1359, %B512 ], [ %busy.7.4301, %B1164 ]
  %exitcond380.not = icmp eq i64 %.219, %.313
  br i1 %exitcond380.not, label %B1206, label %B150

B106.endif:
  %waiting.3.0 = phi i64 [ %waiting.2.1.lcssa, %B1222 ], [ 0, %B106.endif.preheader ]
  %busy.5.0 = phi i64 [ %busy.4.1.lcssa, %B1222 ], [ 0, %B106.endif.preheader ]
  %samples.2.0 = phi i64 [ %.929, %B1222 ], [ 0, %B106.endif.preheader ]
  %.219 = load i64, ptr %.44, align 8
  %.300353.not = icmp slt i64 %.219, 1
  br i1 %.300353.not, label %B1206, label %B150

B246.endif:
  %.374 = getelementptr i64, ptr %arg.walks, i64 %.347
  %.375 = load i64, ptr %.374, align 8
  %.383 = load i64, ptr %sunkaddr119, align 8
  %.384 = inttoptr i64 %.383 to ptr
  %.8.i = load i64, ptr %sunkaddr120, align 8, !noalias !365
  %.9.i = inttoptr i64 %.8.i to ptr
  %.10.i = getelementptr i8, ptr %.9.i, i64 80
  %.11.i = load i64, ptr %.10.i, align 8, !noalias !365
  %.13.i = load i64, ptr %.44, align 8, !noalias !365
  %.14.i = mul nsw i64 %.13.i, %.11.i
  %.15.i = getelementptr double, ptr %.384, i64 %.14.i
  %.411 = getelementptr double, ptr %.15.i, i64 %.306351354
  %.412 = load double, ptr %.411, align 8
  %.413 = fcmp oeq double %.412, 1.000000e+00
  %3 = inttoptr i64 %.375 to ptr
  br i1 %.413, label %B362.endif, label %B608

B362.endif:
  %.420 = getelementptr double, ptr %.384, i64 %.306351354
  %.421 = load double, ptr %.420, align 8
  %.423 = getelementptr i8, ptr %3, i64 424
  %.424 = load i64, ptr %.423, align 8
  %.426 = getelementptr i8, ptr %3, i64 216
  %.428 = load double, ptr %.426, align 8
  %.429 = fcmp oeq double %.428, 0.000000e+00
  %.15.i15 = zext i1 %.429 to i64
  %.455 = add nsw i64 %.424, %.15.i15
  %.457 = getelementptr i8, ptr %3, i64 344
  store double %.421, ptr %.457, align 8
  store i64 %.455, ptr %.423, align 8
  %.464 = tail call i64 @is_plain(ptr nonnull %3)
  %.465 = icmp eq i64 %.464, 1
  %.485 = load i64, ptr %sunkaddr119, align 8
  %4 = inttoptr i64 %.485 to ptr
  br i1 %.465, label %B512, label %B560
}


define i64 @side_by_side(ptr %.1, ptr readonly %.2, i64 %.3, ptr writeonly %.4) local_unnamed_addr #0 {
entry:
  %.6 = alloca i64, align 8
  store i64 0, ptr %.6, align 8
  %.10 = call i32 @_ZN18biped_adrc_kernels12side_by_sideB4v115B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a8int64_2ax8int64_2a(ptr nonnull %.6, ptr nonnull poison, ptr %.1, ptr %.2, i64 %.3, ptr %.4) #0
  %.20 = load i64, ptr %.6, align 8
  ret i64 %.20
}


define i32 @_ZN18biped_adrc_kernels11move_besideB4v116B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a8int64_2ax8int64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.s, ptr readonly %arg.walks, i64 %arg.first, ptr %arg.impacts) local_unnamed_addr #0 {
B0.endif:
  %.6.i8 = alloca ptr, align 8
  %.6.i = alloca ptr, align 8
  %.7.i2 = alloca ptr, align 8
  %.5.i = alloca ptr, align 8
  %.35 = getelementptr i8, ptr %arg.s, i64 568
  %.36 = load i64, ptr %.35, align 8
  %.119213.not = icmp slt i64 %.36, 1
  br i1 %.119213.not, label %common.ret, label %B58.lr.ph

B58.lr.ph:
  %0 = shl i64 %arg.first, 3
  %scevgep141 = getelementptr i8, ptr %arg.walks, i64 %0
  %scevgep143 = getelementptr i8, ptr %arg.impacts, i64 %0
  %sunkaddr = getelementptr i8, ptr %arg.s, i64 616
  %sunkaddr146 = getelementptr i8, ptr %arg.s, i64 632
  %sunkaddr148 = getelementptr i8, ptr %arg.s, i64 328
  %sunkaddr149 = getelementptr i8, ptr %arg.s, i64 336
  %sunkaddr165 = getelementptr i8, ptr %arg.s, i64 592
  br label %B58

B58:
  %pushed.2.0217 = phi i64 [ 0, %B58.lr.ph ], [ %pushed.3.1, %B574 ]
  %some.2.0216 = phi i64 [ 0, %B58.lr.ph ], [ %some.3.1, %B574 ]
  %.125212214 = phi i64 [ 0, %B58.lr.ph ], [ %.132, %B574 ]
  %.132 = add nuw nsw i64 %.125212214, 1
  %.176 = load i64, ptr %sunkaddr, align 8
  %.177 = inttoptr i64 %.176 to ptr
  %1 = shl i64 %.125212214, 3
  %scevgep140 = getelementptr i8, ptr %.177, i64 %1
  store i64 0, ptr %scevgep140, align 8
  %.183 = load i64, ptr %sunkaddr146, align 8
  %.184 = inttoptr i64 %.183 to ptr
  %scevgep139 = getelementptr i8, ptr %.184, i64 %1
  %.187 = load i64, ptr %scevgep139, align 8
  %.188.not = icmp eq i64 %.187, 0
  br i1 %.188.not, label %B574, label %B124

B124:
  %scevgep144 = getelementptr i8, ptr %scevgep143, i64 %1
  %.199 = load i64, ptr %scevgep144, align 8
  %.200 = icmp eq i64 %.199, 0
  br i1 %.200, label %B148, label %B574

B148:
  %scevgep142 = getelementptr i8, ptr %scevgep141, i64 %1
  %.209 = load i64, ptr %scevgep142, align 8
  %.221 = icmp eq i64 %.187, 1
  %2 = inttoptr i64 %.209 to ptr
  br i1 %.221, label %B224, label %B278

B224:
  %.9.i1 = call i32 @_ZN18biped_adrc_kernels11put_numbersB3v92B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a(ptr nonnull %.5.i, ptr nonnull poison, ptr nonnull readonly %arg.s, i64 %.125212214, ptr readonly %2) #0
  %.229 = load i64, ptr %sunkaddr146, align 8
  %.230 = inttoptr i64 %.229 to ptr
  %scevgep138 = getelementptr i8, ptr %.230, i64 %1
  store i64 2, ptr %scevgep138, align 8
  br label %B278

B278:
  %.242 = getelementptr i8, ptr %2, i64 328
  %.243 = load i64, ptr %.242, align 8
  %.244 = inttoptr i64 %.243 to ptr
  %.247 = load i64, ptr %sunkaddr148, align 8
  %.248 = inttoptr i64 %.247 to ptr
  %.250 = getelementptr i8, ptr %2, i64 88
  %.251 = load i64, ptr %.250, align 8
  %.11.i3 = call i32 @_ZN18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.7.i2, ptr nonnull poison, ptr nonnull readonly %arg.s, i64 %.125212214, ptr readonly %.244, ptr %.248, i64 %.251) #0
  %.256 = getelementptr i8, ptr %2, i64 336
  %.257 = load i64, ptr %.256, align 8
  %.258 = inttoptr i64 %.257 to ptr
  %.261 = load i64, ptr %sunkaddr149, align 8
  %.262 = inttoptr i64 %.261 to ptr
  %invariant.gep.i = getelementptr double, ptr %.262, i64 %.125212214
  br label %B36.epil.i

B36.epil.i:
  %lsr.iv.i = phi i64 [ %lsr.iv.next.i, %B36.epil.i ], [ 2, %B278 ]
  %.1044042.epil.i = phi i64 [ %.111.epil.i, %B36.epil.i ], [ 0, %B278 ]
  %.111.epil.i = add nuw nsw i64 %.1044042.epil.i, 1
  %3 = shl i64 %.1044042.epil.i, 3
  %scevgep.i = getelementptr i8, ptr %.258, i64 %3
  %.138.epil.i = load double, ptr %scevgep.i, align 8, !noalias !368
  %.141.epil.i = load i64, ptr %.35, align 8, !noalias !368
  %.142.epil.i = mul nsw i64 %.141.epil.i, %.1044042.epil.i
  %gep.epil.i = getelementptr double, ptr %invariant.gep.i, i64 %.142.epil.i
  store double %.138.epil.i, ptr %gep.epil.i, align 8, !noalias !368
  %lsr.iv.next.i = add nsw i64 %lsr.iv.i, -1
  %epil.iter.cmp.not.i = icmp eq i64 %lsr.iv.next.i, 0
  br i1 %epil.iter.cmp.not.i, label %_ZN18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax.exit, label %B36.epil.i, !llvm.loop !257

_ZN18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax.exit:
  %.267 = tail call i64 @is_plain(ptr nonnull %2)
  %.268 = icmp eq i64 %.267, 1
  br i1 %.268, label %B442.endif, label %B574

B574:
  %some.3.1 = phi i64 [ %.285, %B442.endif ], [ %some.2.0216, %_ZN18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax.exit ], [ %some.2.0216, %B124 ], [ %some.2.0216, %B58 ]
  %pushed.3.1 = phi i64 [ %.13.i, %B442.endif ], [ %pushed.2.0217, %_ZN18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax.exit ], [ %pushed.2.0217, %B124 ], [ %pushed.2.0217, %B58 ]
  %exitcond.not = icmp eq i64 %.36, %.132
  br i1 %exitcond.not, label %B578, label %B58

B578:
  %4 = icmp sgt i64 %some.3.1, 1
  br i1 %4, label %B622, label %common.ret

B622:
  %5 = icmp sgt i64 %pushed.3.1, 0
  %.371 = getelementptr i8, ptr %arg.s, i64 600
  %.372 = load i64, ptr %.371, align 8
  %.368 = load i64, ptr %sunkaddr165, align 8
  br i1 %5, label %B636, label %B652.endif.endif

B636:
  %sunkaddr151 = getelementptr i8, ptr %arg.s, i64 576
  %.466 = load i64, ptr %sunkaddr151, align 8
  br label %B652.endif.endif

B622.1.loopexit.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B622.1, label %B800.endif.endif.epil.preheader

B800.endif.endif.epil.preheader:
  %.600223226.epil.init = phi i64 [ 0, %B800.endif.endif.preheader ], [ %unroll_iter, %B622.1.loopexit.unr-lcssa ]
  %6 = shl i64 %.600223226.epil.init, 3
  %scevgep108 = getelementptr i8, ptr %36, i64 %6
  br label %B800.endif.endif.epil

B800.endif.endif.epil:
  %lsr.iv113 = phi i64 [ %lsr.iv.next114, %B800.endif.endif.epil ], [ %xtraiter, %B800.endif.endif.epil.preheader ]
  %lsr.iv109 = phi ptr [ %scevgep110, %B800.endif.endif.epil ], [ %scevgep108, %B800.endif.endif.epil.preheader ]
  %.8.i13.epil = load i64, ptr %.7.i, align 8, !noalias !371
  %.9.i14.epil = inttoptr i64 %.8.i13.epil to ptr
  %.10.i15.epil = getelementptr i8, ptr %.9.i14.epil, i64 8
  %.11.i16.epil = load i64, ptr %.10.i15.epil, align 8, !noalias !371
  %.13.i18.epil = load i64, ptr %.35, align 8, !noalias !371
  %7 = shl i64 %.11.i16.epil, 3
  %8 = mul i64 %7, %.13.i18.epil
  %scevgep112 = getelementptr i8, ptr %lsr.iv109, i64 %8
  store double 0.000000e+00, ptr %scevgep112, align 8
  %.8.i58.epil = load i64, ptr %.7.i, align 8, !noalias !374
  %.9.i59.epil = inttoptr i64 %.8.i58.epil to ptr
  %.10.i60.epil = getelementptr i8, ptr %.9.i59.epil, i64 112
  %.11.i61.epil = load i64, ptr %.10.i60.epil, align 8, !noalias !374
  %.13.i63.epil = load i64, ptr %.35, align 8, !noalias !374
  %9 = shl i64 %.11.i61.epil, 3
  %10 = mul i64 %9, %.13.i63.epil
  %scevgep111 = getelementptr i8, ptr %lsr.iv109, i64 %10
  store double 0.000000e+00, ptr %scevgep111, align 8
  %scevgep110 = getelementptr i8, ptr %lsr.iv109, i64 8
  %lsr.iv.next114 = add nsw i64 %lsr.iv113, -1
  %epil.iter.cmp.not = icmp eq i64 %lsr.iv.next114, 0
  br i1 %epil.iter.cmp.not, label %B622.1, label %B800.endif.endif.epil, !llvm.loop !377

B622.1:
  br i1 %5, label %B636.1, label %B652.endif.endif.1

B636.1:
  %sunkaddr154 = getelementptr i8, ptr %arg.s, i64 576
  %.466.1 = load i64, ptr %sunkaddr154, align 8
  br label %B652.endif.endif.1

B652.endif.endif.1:
  %"$phi652.1.2.1.1" = phi i64 [ %.466.1, %B636.1 ], [ 0, %B622.1 ]
  %11 = inttoptr i64 %.372 to ptr
  %.8.i22 = load i64, ptr %.7.i, align 8, !noalias !378
  %.9.i23 = inttoptr i64 %.8.i22 to ptr
  %.10.i24 = getelementptr i8, ptr %.9.i23, i64 120
  %.11.i25 = load i64, ptr %.10.i24, align 8, !noalias !378
  %.13.i27 = load i64, ptr %.35, align 8, !noalias !378
  %.14.i28 = mul nsw i64 %.13.i27, %.11.i25
  %.15.i29 = getelementptr double, ptr %11, i64 %.14.i28
  store i64 %"$phi652.1.2.1.1", ptr %.15.i29, align 8
  %.509.1 = load i64, ptr %sunkaddr170, align 8
  %.510.1 = add nsw i64 %.509.1, 2
  %.513.1 = load i64, ptr %.35, align 8
  %.514.1 = mul nsw i64 %.510.1, %.513.1
  %.594225.not.1 = icmp slt i64 %.514.1, 1
  br i1 %.594225.not.1, label %B904.1, label %B800.endif.endif.1.preheader

B800.endif.endif.1.preheader:
  %xtraiter72 = and i64 %.514.1, 3
  %12 = icmp samesign ult i64 %.514.1, 4
  br i1 %12, label %B800.endif.endif.1.epil.preheader, label %B800.endif.endif.1.preheader.new

B800.endif.endif.1.preheader.new:
  %unroll_iter76 = and i64 %.514.1, 9223372036854775804
  br label %B800.endif.endif.1

B800.endif.endif.1:
  %.600223226.1 = phi i64 [ 0, %B800.endif.endif.1.preheader.new ], [ %.607.1.3, %B800.endif.endif.1 ]
  %.8.i31 = load i64, ptr %.7.i, align 8, !noalias !381
  %.9.i32 = inttoptr i64 %.8.i31 to ptr
  %.10.i33 = getelementptr i8, ptr %.9.i32, i64 8
  %.11.i34 = load i64, ptr %.10.i33, align 8, !noalias !381
  %.13.i36 = load i64, ptr %.35, align 8, !noalias !381
  %13 = shl i64 %.11.i34, 3
  %14 = mul i64 %13, %.13.i36
  %scevgep106 = getelementptr i8, ptr %11, i64 %14
  %15 = shl i64 %.600223226.1, 3
  %scevgep107 = getelementptr i8, ptr %scevgep106, i64 %15
  store double 0.000000e+00, ptr %scevgep107, align 8
  %.8.i40 = load i64, ptr %.7.i, align 8, !noalias !384
  %.9.i41 = inttoptr i64 %.8.i40 to ptr
  %.10.i42 = getelementptr i8, ptr %.9.i41, i64 112
  %.11.i43 = load i64, ptr %.10.i42, align 8, !noalias !384
  %.13.i45 = load i64, ptr %.35, align 8, !noalias !384
  %16 = shl i64 %.11.i43, 3
  %17 = mul i64 %16, %.13.i45
  %scevgep104 = getelementptr i8, ptr %11, i64 %17
  %scevgep105 = getelementptr i8, ptr %scevgep104, i64 %15
  store double 0.000000e+00, ptr %scevgep105, align 8
  %.8.i31.1 = load i64, ptr %.7.i, align 8, !noalias !381
  %.9.i32.1 = inttoptr i64 %.8.i31.1 to ptr
  %.10.i33.1 = getelementptr i8, ptr %.9.i32.1, i64 8
  %.11.i34.1 = load i64, ptr %.10.i33.1, align 8, !noalias !381
  %.13.i36.1 = load i64, ptr %.35, align 8, !noalias !381
  %18 = shl i64 %.11.i34.1, 3
  %19 = mul i64 %18, %.13.i36.1
  %scevgep98 = getelementptr i8, ptr %11, i64 %19
  %scevgep99 = getelementptr i8, ptr %scevgep98, i64 %15
  %scevgep100 = getelementptr i8, ptr %scevgep99, i64 8
  store double 0.000000e+00, ptr %scevgep100, align 8
  %.8.i40.1 = load i64, ptr %.7.i, align 8, !noalias !384
  %.9.i41.1 = inttoptr i64 %.8.i40.1 to ptr
  %.10.i42.1 = getelementptr i8, ptr %.9.i41.1, i64 112
  %.11.i43.1 = load i64, ptr %.10.i42.1, align 8, !noalias !384
  %.13.i45.1 = load i64, ptr %.35, align 8, !noalias !384
  %20 = shl i64 %.11.i43.1, 3
  %21 = mul i64 %20, %.13.i45.1
  %scevgep101 = getelementptr i8, ptr %11, i64 %21
  %scevgep102 = getelementptr i8, ptr %scevgep101, i64 %15
  %scevgep103 = getelementptr i8, ptr %scevgep102, i64 8
  store double 0.000000e+00, ptr %scevgep103, align 8
  %.8.i31.2 = load i64, ptr %.7.i, align 8, !noalias !381
  %.9.i32.2 = inttoptr i64 %.8.i31.2 to ptr
  %.10.i33.2 = getelementptr i8, ptr %.9.i32.2, i64 8
  %.11.i34.2 = load i64, ptr %.10.i33.2, align 8, !noalias !381
  %.13.i36.2 = load i64, ptr %.35, align 8, !noalias !381
  %22 = shl i64 %.11.i34.2, 3
  %23 = mul i64 %22, %.13.i36.2
  %scevgep92 = getelementptr i8, ptr %11, i64 %23
  %scevgep93 = getelementptr i8, ptr %scevgep92, i64 %15
  %scevgep94 = getelementptr i8, ptr %scevgep93, i64 16
  store double 0.000000e+00, ptr %scevgep94, align 8
  %.8.i40.2 = load i64, ptr %.7.i, align 8, !noalias !384
  %.9.i41.2 = inttoptr i64 %.8.i40.2 to ptr
  %.10.i42.2 = getelementptr i8, ptr %.9.i41.2, i64 112
  %.11.i43.2 = load i64, ptr %.10.i42.2, align 8, !noalias !384
  %.13.i45.2 = load i64, ptr %.35, align 8, !noalias !384
  %24 = shl i64 %.11.i43.2, 3
  %25 = mul i64 %24, %.13.i45.2
  %scevgep95 = getelementptr i8, ptr %11, i64 %25
  %scevgep96 = getelementptr i8, ptr %scevgep95, i64 %15
  %scevgep97 = getelementptr i8, ptr %scevgep96, i64 16
  store double 0.000000e+00, ptr %scevgep97, align 8
  %.607.1.3 = add nuw i64 %.600223226.1, 4
  %.8.i31.3 = load i64, ptr %.7.i, align 8, !noalias !381
  %.9.i32.3 = inttoptr i64 %.8.i31.3 to ptr
  %.10.i33.3 = getelementptr i8, ptr %.9.i32.3, i64 8
  %.11.i34.3 = load i64, ptr %.10.i33.3, align 8, !noalias !381
  %.13.i36.3 = load i64, ptr %.35, align 8, !noalias !381
  %26 = shl i64 %.11.i34.3, 3
  %27 = mul i64 %26, %.13.i36.3
  %scevgep86 = getelementptr i8, ptr %11, i64 %27
  %scevgep87 = getelementptr i8, ptr %scevgep86, i64 %15
  %scevgep88 = getelementptr i8, ptr %scevgep87, i64 24
  store double 0.000000e+00, ptr %scevgep88, align 8
  %.8.i40.3 = load i64, ptr %.7.i, align 8, !noalias !384
  %.9.i41.3 = inttoptr i64 %.8.i40.3 to ptr
  %.10.i42.3 = getelementptr i8, ptr %.9.i41.3, i64 112
  %.11.i43.3 = load i64, ptr %.10.i42.3, align 8, !noalias !384
  %.13.i45.3 = load i64, ptr %.35, align 8, !noalias !384
  %28 = shl i64 %.11.i43.3, 3
  %29 = mul i64 %28, %.13.i45.3
  %scevgep89 = getelementptr i8, ptr %11, i64 %29
  %scevgep90 = getelementptr i8, ptr %scevgep89, i64 %15
  %scevgep91 = getelementptr i8, ptr %scevgep90, i64 24
  store double 0.000000e+00, ptr %scevgep91, align 8
  %niter77.ncmp.3 = icmp eq i64 %unroll_iter76, %.607.1.3
  br i1 %niter77.ncmp.3, label %B904.1.loopexit.unr-lcssa, label %B800.endif.endif.1

B904.1.loopexit.unr-lcssa:
  %lcmp.mod74.not = icmp eq i64 %xtraiter72, 0
  br i1 %lcmp.mod74.not, label %B904.1, label %B800.endif.endif.1.epil.preheader

B800.endif.endif.1.epil.preheader:
  %.600223226.1.epil.init = phi i64 [ 0, %B800.endif.endif.1.preheader ], [ %unroll_iter76, %B904.1.loopexit.unr-lcssa ]
  %30 = shl i64 %.600223226.1.epil.init, 3
  %scevgep81 = getelementptr i8, ptr %11, i64 %30
  br label %B800.endif.endif.1.epil

B800.endif.endif.1.epil:
  %lsr.iv85 = phi i64 [ %lsr.iv.next, %B800.endif.endif.1.epil ], [ %xtraiter72, %B800.endif.endif.1.epil.preheader ]
  %lsr.iv = phi ptr [ %scevgep82, %B800.endif.endif.1.epil ], [ %scevgep81, %B800.endif.endif.1.epil.preheader ]
  %.8.i31.epil = load i64, ptr %.7.i, align 8, !noalias !381
  %.9.i32.epil = inttoptr i64 %.8.i31.epil to ptr
  %.10.i33.epil = getelementptr i8, ptr %.9.i32.epil, i64 8
  %.11.i34.epil = load i64, ptr %.10.i33.epil, align 8, !noalias !381
  %.13.i36.epil = load i64, ptr %.35, align 8, !noalias !381
  %31 = shl i64 %.11.i34.epil, 3
  %32 = mul i64 %31, %.13.i36.epil
  %scevgep84 = getelementptr i8, ptr %lsr.iv, i64 %32
  store double 0.000000e+00, ptr %scevgep84, align 8
  %.8.i40.epil = load i64, ptr %.7.i, align 8, !noalias !384
  %.9.i41.epil = inttoptr i64 %.8.i40.epil to ptr
  %.10.i42.epil = getelementptr i8, ptr %.9.i41.epil, i64 112
  %.11.i43.epil = load i64, ptr %.10.i42.epil, align 8, !noalias !384
  %.13.i45.epil = load i64, ptr %.35, align 8, !noalias !384
  %33 = shl i64 %.11.i43.epil, 3
  %34 = mul i64 %33, %.13.i45.epil
  %scevgep83 = getelementptr i8, ptr %lsr.iv, i64 %34
  store double 0.000000e+00, ptr %scevgep83, align 8
  %scevgep82 = getelementptr i8, ptr %lsr.iv, i64 8
  %lsr.iv.next = add nsw i64 %lsr.iv85, -1
  %epil.iter73.cmp.not = icmp eq i64 %lsr.iv.next, 0
  br i1 %epil.iter73.cmp.not, label %B904.1, label %B800.endif.endif.1.epil, !llvm.loop !387

B904.1:
  %.707 = tail call ptr @sample_all(ptr nonnull %arg.s)
  %.710 = load i64, ptr %.35, align 8
  %.790249.not = icmp slt i64 %.710, 1
  br i1 %.790249.not, label %common.ret, label %B978.lr.ph

B978:
  %.796248250 = phi i64 [ 0, %B978.lr.ph ], [ %.803, %B1283 ]
  %.803 = add nuw nsw i64 %.796248250, 1
  %.833 = load i64, ptr %sunkaddr, align 8
  %.834 = inttoptr i64 %.833 to ptr
  %35 = shl i64 %.796248250, 3
  %scevgep80 = getelementptr i8, ptr %.834, i64 %35
  %.837 = load i64, ptr %scevgep80, align 8
  %.838.not = icmp eq i64 %.837, 0
  br i1 %.838.not, label %B1283, label %B1014.endif

B1140:
  %.10.i7 = call i32 @_ZN18biped_adrc_kernels5leaveB3v93B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a(ptr nonnull %.6.i, ptr nonnull poison, ptr nonnull readonly %arg.s, i64 %.796248250, ptr nonnull readonly %56, ptr nonnull readonly %.855) #0
  %.896 = load i64, ptr %.371, align 8
  %.897 = inttoptr i64 %.896 to ptr
  %scevgep78 = getelementptr i8, ptr %.897, i64 %35
  %.900 = load double, ptr %scevgep78, align 8
  %.902 = getelementptr i8, ptr %56, i64 344
  store double %.900, ptr %.902, align 8
  %scevgep = getelementptr i8, ptr %55, i64 %35
  store i64 -2, ptr %scevgep, align 8
  br label %B1283

B1252:
  %.919 = getelementptr i8, ptr %56, i64 440
  %.920 = load i64, ptr %.919, align 8
  %.922 = getelementptr i8, ptr %56, i64 408
  store i64 %.920, ptr %.922, align 8
  br label %B1283

common.ret:
  store ptr null, ptr %retptr, align 8
  ret i32 0

B1283:
  %exitcond281.not = icmp eq i64 %.710, %.803
  br i1 %exitcond281.not, label %common.ret, label %B978

B442.endif:
  %.272 = load i64, ptr %sunkaddr165, align 8
  %.273 = inttoptr i64 %.272 to ptr
  %.10.i9 = call i32 @_ZN18biped_adrc_kernels5enterB4v102B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax8int64_2a10float64_2a(ptr nonnull %.6.i8, ptr nonnull poison, ptr nonnull readonly %arg.s, i64 %.125212214, ptr nonnull %2, ptr %.273) #0
  %.281 = load i64, ptr %scevgep142, align 8
  %.289 = getelementptr i8, ptr %2, i64 200
  %.290 = load i64, ptr %.289, align 8
  %.13.i = tail call i64 @llvm.smax.i64(i64 %.290, i64 %pushed.2.0217)
  %.285 = add nsw i64 %some.2.0216, 1
  %.326 = load i64, ptr %sunkaddr, align 8
  %.327 = inttoptr i64 %.326 to ptr
  %scevgep137 = getelementptr i8, ptr %.327, i64 %1
  store i64 %.281, ptr %scevgep137, align 8
  br label %B574

B652.endif.endif:
  %"$phi652.1.2.1" = phi i64 [ %.466, %B636 ], [ 0, %B622 ]
  %36 = inttoptr i64 %.368 to ptr
  %.7.i = getelementptr i8, ptr %arg.s, i64 584
  %.8.i = load i64, ptr %.7.i, align 8, !noalias !388
  %.9.i = inttoptr i64 %.8.i to ptr
  %.10.i = getelementptr i8, ptr %.9.i, i64 120
  %.11.i = load i64, ptr %.10.i, align 8, !noalias !388
  %.13.i11 = load i64, ptr %.35, align 8, !noalias !388
  %.14.i = mul nsw i64 %.13.i11, %.11.i
  %.15.i = getelementptr double, ptr %36, i64 %.14.i
  store i64 %"$phi652.1.2.1", ptr %.15.i, align 8
  %sunkaddr170 = getelementptr i8, ptr %arg.s, i64 72
  %.509 = load i64, ptr %sunkaddr170, align 8
  %.510 = add nsw i64 %.509, 2
  %.513 = load i64, ptr %.35, align 8
  %.514 = mul nsw i64 %.510, %.513
  %.594225.not = icmp slt i64 %.514, 1
  br i1 %.594225.not, label %B622.1, label %B800.endif.endif.preheader

B800.endif.endif.preheader:
  %xtraiter = and i64 %.514, 3
  %37 = icmp samesign ult i64 %.514, 4
  br i1 %37, label %B800.endif.endif.epil.preheader, label %B800.endif.endif.preheader.new

B800.endif.endif.preheader.new:
  %unroll_iter = and i64 %.514, 9223372036854775804
  br label %B800.endif.endif

B800.endif.endif:
  %.600223226 = phi i64 [ 0, %B800.endif.endif.preheader.new ], [ %.607.3, %B800.endif.endif ]
  %.8.i13 = load i64, ptr %.7.i, align 8, !noalias !371
  %.9.i14 = inttoptr i64 %.8.i13 to ptr
  %.10.i15 = getelementptr i8, ptr %.9.i14, i64 8
  %.11.i16 = load i64, ptr %.10.i15, align 8, !noalias !371
  %.13.i18 = load i64, ptr %.35, align 8, !noalias !371
  %38 = shl i64 %.11.i16, 3
  %39 = mul i64 %38, %.13.i18
  %scevgep135 = getelementptr i8, ptr %36, i64 %39
  %40 = shl i64 %.600223226, 3
  %scevgep136 = getelementptr i8, ptr %scevgep135, i64 %40
  store double 0.000000e+00, ptr %scevgep136, align 8
  %.8.i58 = load i64, ptr %.7.i, align 8, !noalias !374
  %.9.i59 = inttoptr i64 %.8.i58 to ptr
  %.10.i60 = getelementptr i8, ptr %.9.i59, i64 112
  %.11.i61 = load i64, ptr %.10.i60, align 8, !noalias !374
  %.13.i63 = load i64, ptr %.35, align 8, !noalias !374
  %41 = shl i64 %.11.i61, 3
  %42 = mul i64 %41, %.13.i63
  %scevgep133 = getelementptr i8, ptr %36, i64 %42
  %scevgep134 = getelementptr i8, ptr %scevgep133, i64 %40
  store double 0.000000e+00, ptr %scevgep134, align 8
  %.8.i13.1 = load i64, ptr %.7.i, align 8, !noalias !371
  %.9.i14.1 = inttoptr i64 %.8.i13.1 to ptr
  %.10.i15.1 = getelementptr i8, ptr %.9.i14.1, i64 8
  %.11.i16.1 = load i64, ptr %.10.i15.1, align 8, !noalias !371
  %.13.i18.1 = load i64, ptr %.35, align 8, !noalias !371
  %43 = shl i64 %.11.i16.1, 3
  %44 = mul i64 %43, %.13.i18.1
  %scevgep127 = getelementptr i8, ptr %36, i64 %44
  %scevgep128 = getelementptr i8, ptr %scevgep127, i64 %40
  %scevgep129 = getelementptr i8, ptr %scevgep128, i64 8
  store double 0.000000e+00, ptr %scevgep129, align 8
  %.8.i58.1 = load i64, ptr %.7.i, align 8, !noalias !374
  %.9.i59.1 = inttoptr i64 %.8.i58.1 to ptr
  %.10.i60.1 = getelementptr i8, ptr %.9.i59.1, i64 112
  %.11.i61.1 = load i64, ptr %.10.i60.1, align 8, !noalias !374
  %.13.i63.1 = load i64, ptr %.35, align 8, !noalias !374
  %45 = shl i64 %.11.i61.1, 3
  %46 = mul i64 %45, %.13.i63.1
  %scevgep130 = getelementptr i8, ptr %36, i64 %46
  %scevgep131 = getelementptr i8, ptr %scevgep130, i64 %40
  %scevgep132 = getelementptr i8, ptr %scevgep131, i64 8
  store double 0.000000e+00, ptr %scevgep132, align 8
  %.8.i13.2 = load i64, ptr %.7.i, align 8, !noalias !371
  %.9.i14.2 = inttoptr i64 %.8.i13.2 to ptr
  %.10.i15.2 = getelementptr i8, ptr %.9.i14.2, i64 8
  %.11.i16.2 = load i64, ptr %.10.i15.2, align 8, !noalias !371
  %.13.i18.2 = load i64, ptr %.35, align 8, !noalias !371
  %47 = shl i64 %.11.i16.2, 3
  %48 = mul i64 %47, %.13.i18.2
  %scevgep121 = getelementptr i8, ptr %36, i64 %48
  %scevgep122 = getelementptr i8, ptr %scevgep121, i64 %40
  %scevgep123 = getelementptr i8, ptr %scevgep122, i64 16
  store double 0.000000e+00, ptr %scevgep123, align 8
  %.8.i58.2 = load i64, ptr %.7.i, align 8, !noalias !374
  %.9.i59.2 = inttoptr i64 %.8.i58.2 to ptr
  %.10.i60.2 = getelementptr i8, ptr %.9.i59.2, i64 112
  %.11.i61.2 = load i64, ptr %.10.i60.2, align 8, !noalias !374
  %.13.i63.2 = load i64, ptr %.35, align 8, !noalias !374
  %49 = shl i64 %.11.i61.2, 3
  %50 = mul i64 %49, %.13.i63.2
  %scevgep124 = getelementptr i8, ptr %36, i64 %50
  %scevgep125 = getelementptr i8, ptr %scevgep124, i64 %40
  %scevgep126 = getelementptr i8, ptr %scevgep125, i64 16
  store double 0.000000e+00, ptr %scevgep126, align 8
  %.607.3 = add nuw i64 %.600223226, 4
  %.8.i13.3 = load i64, ptr %.7.i, align 8, !noalias !371
  %.9.i14.3 = inttoptr i64 %.8.i13.3 to ptr
  %.10.i15.3 = getelementptr i8, ptr %.9.i14.3, i64 8
  %.11.i16.3 = load i64, ptr %.10.i15.3, align 8, !noalias !371
  %.13.i18.3 = load i64, ptr %.35, align 8, !noalias !371
  %51 = shl i64 %.11.i16.3, 3
  %52 = mul i64 %51, %.13.i18.3
  %scevgep115 = getelementptr i8, ptr %36, i64 %52
  %scevgep116 = getelementptr i8, ptr %scevgep115, i64 %40
  %scevgep117 = getelementptr i8, ptr %scevgep116, i64 24
  store double 0.000000e+00, ptr %scevgep117, align 8
  %.8.i58.3 = load i64, ptr %.7.i, align 8, !noalias !374
  %.9.i59.3 = inttoptr i64 %.8.i58.3 to ptr
  %.10.i60.3 = getelementptr i8, ptr %.9.i59.3, i64 112
  %.11.i61.3 = load i64, ptr %.10.i60.3, align 8, !noalias !374
  %.13.i63.3 = load i64, ptr %.35, align 8, !noalias !374
  %53 = shl i64 %.11.i61.3, 3
  %54 = mul i64 %53, %.13.i63.3
  %scevgep118 = getelementptr i8, ptr %36, i64 %54
  %scevgep119 = getelementptr i8, ptr %scevgep118, i64 %40
  %scevgep120 = getelementptr i8, ptr %scevgep119, i64 24
  store double 0.000000e+00, ptr %scevgep120, align 8
  %niter.ncmp.3 = icmp eq i64 %unroll_iter, %.607.3
  br i1 %niter.ncmp.3, label %B622.1.loopexit.unr-lcssa, label %B800.endif.endif

B978.lr.ph:
  %55 = getelementptr i64, ptr %arg.impacts, i64 %arg.first
  br label %B978

B1014.endif:
  %.854 = load i64, ptr %.371, align 8
  %.855 = inttoptr i64 %.854 to ptr
  %.8.i49 = load i64, ptr %.7.i, align 8, !noalias !391
  %.9.i50 = inttoptr i64 %.8.i49 to ptr
  %.10.i51 = getelementptr i8, ptr %.9.i50, i64 80
  %.11.i52 = load i64, ptr %.10.i51, align 8, !noalias !391
  %.13.i54 = load i64, ptr %.35, align 8, !noalias !391
  %.14.i55 = mul nsw i64 %.13.i54, %.11.i52
  %.15.i56 = getelementptr double, ptr %.855, i64 %.14.i55
  %scevgep79 = getelementptr i8, ptr %.15.i56, i64 %35
  %.883 = load double, ptr %scevgep79, align 8
  %.884 = fcmp oeq double %.883, 1.000000e+00
  %56 = inttoptr i64 %.837 to ptr
  br i1 %.884, label %B1140, label %B1252
}


define ptr @move_beside(ptr readonly %.1, ptr readonly %.2, i64 %.3, ptr %.4) local_unnamed_addr #0 {
entry:
  %.6 = alloca ptr, align 8
  store ptr null, ptr %.6, align 8
  %.10 = call i32 @_ZN18biped_adrc_kernels11move_besideB4v116B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a8int64_2ax8int64_2a(ptr nonnull %.6, ptr nonnull poison, ptr %.1, ptr %.2, i64 %.3, ptr %.4) #0
  %.20 = load ptr, ptr %.6, align 8
  ret ptr %.20
}


define i32 @_ZN18biped_adrc_kernels7samplesB4v119B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axx10float64_2a10float64_2a8int64_2a8int64_2a8int64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr readonly %arg.walks, i64 %arg.count, i64 %arg.width, ptr readonly %arg.inputs, ptr writeonly %arg.states, ptr %arg.codes, ptr %arg.impacts, ptr readonly %arg.teams) local_unnamed_addr #0 {
B0.endif:
  %.5.i1 = alloca ptr, align 8
  %.3.i = alloca i64, align 8
  %.6.i = alloca ptr, align 8
  %.188 = alloca ptr, align 8
  %excinfo.1 = alloca ptr, align 8
  %.731 = alloca ptr, align 8
  %excinfo.4 = alloca ptr, align 8
  %.69 = icmp sgt i64 %arg.count, 0
  br i1 %.69, label %B40, label %B356

B40:
  %.119168170 = phi i64 [ %.126, %B354 ], [ 0, %B0.endif ]
  %.126 = add nuw nsw i64 %.119168170, 1
  %0 = shl i64 %.119168170, 3
  %scevgep15 = getelementptr i8, ptr %arg.impacts, i64 %0
  store i64 -1, ptr %scevgep15, align 8
  %scevgep14 = getelementptr i8, ptr %arg.codes, i64 %0
  %.161 = load i64, ptr %scevgep14, align 8
  %.162 = icmp eq i64 %.161, 0
  br i1 %.162, label %B86, label %B354

B86:
  %scevgep13 = getelementptr i8, ptr %arg.walks, i64 %0
  %.167 = load i64, ptr %scevgep13, align 8
  %.168.not = icmp eq i64 %.167, 0
  br i1 %.168.not, label %B354, label %B110

B110:
  %.174 = inttoptr i64 %.167 to ptr
  %.175 = getelementptr i8, ptr %.174, i64 88
  %.176 = load i64, ptr %.175, align 8
  %.177 = add nsw i64 %.176, 2
  %.179 = mul nsw i64 %.177, %.119168170
  %.181 = getelementptr double, ptr %arg.inputs, i64 %.179
  %.183 = getelementptr i8, ptr %.174, i64 328
  %.184 = load i64, ptr %.183, align 8
  %.185 = inttoptr i64 %.184 to ptr
  %.192 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.188, ptr nonnull %excinfo.1, ptr %.181, ptr %.185, i64 %.176)
  switch i32 %.192, label %B110.if.if [
    i32 -2, label %B110.endif
    i32 0, label %B110.endif
  ], !prof !8

B354:
  %exitcond.not = icmp eq i64 %arg.count, %.126
  br i1 %exitcond.not, label %B356, label %B40

B356:
  %.240 = load i64, ptr %arg.teams, align 8
  %.241 = icmp sgt i64 %.240, 0
  br i1 %.241, label %B380.else.if, label %B544.endif

B442:
  %.374174176 = phi i64 [ %.381, %B442 ], [ 0, %15 ]
  %.381 = add nuw i64 %.374174176, 1
  %1 = shl i64 %.374174176, 3
  %scevgep11 = getelementptr i8, ptr %arg.teams, i64 %1
  %scevgep12 = getelementptr i8, ptr %scevgep11, i64 8
  %.409 = load i64, ptr %scevgep12, align 8
  %.410 = inttoptr i64 %.409 to ptr
  %.413 = load i64, ptr %arg.teams, align 8
  %.414 = mul nsw i64 %.413, %.374174176
  %.10.i = call i32 @_ZN18biped_adrc_kernels11move_besideB4v116B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a8int64_2ax8int64_2a(ptr nonnull %.6.i, ptr nonnull poison, ptr readonly %.410, ptr readonly %arg.walks, i64 %.414, ptr %arg.impacts) #0
  %exitcond.not4 = icmp eq i64 %.255.1, %.374174176
  br i1 %exitcond.not4, label %B544.endif, label %B442

B576:
  %lsr.iv = phi ptr [ %scevgep, %B576.preheader ], [ %scevgep5, %B1046 ]
  %over.2.0189 = phi i64 [ 0, %B576.preheader ], [ %over.3.1, %B1046 ]
  %.519183187 = phi i64 [ 0, %B576.preheader ], [ %.526, %B1046 ]
  %.526 = add nuw nsw i64 %.519183187, 1
  %2 = shl i64 %.519183187, 3
  %scevgep10 = getelementptr i8, ptr %arg.impacts, i64 %2
  %.561 = load i64, ptr %scevgep10, align 8
  %.562.not = icmp eq i64 %.561, -1
  br i1 %.562.not, label %B1046, label %B602

B602:
  %scevgep9 = getelementptr i8, ptr %arg.walks, i64 %2
  %.569 = load i64, ptr %scevgep9, align 8
  %.570 = inttoptr i64 %.569 to ptr
  %.575 = getelementptr i8, ptr %.570, i64 352
  %.577 = load double, ptr %.575, align 8
  %.585 = icmp eq i64 %.561, -2
  br i1 %.585, label %B734.endif, label %B706

B706:
  store i64 0, ptr %.3.i, align 8
  %.7.i = call i32 @_ZN18biped_adrc_kernels6sampleB3v79B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2a(ptr nonnull %.3.i, ptr nonnull poison, ptr nonnull %.570) #0
  %.17.i = load i64, ptr %.3.i, align 8
  br label %B734.endif

B832:
  %.660 = load i64, ptr %scevgep8, align 8
  %.661 = icmp ne i64 %.660, 0
  %3 = zext i1 %.661 to i64
  br label %B864.endif

B1046:
  %over.3.1 = phi i64 [ %over.2.0189, %B576 ], [ %.696, %B864.endif ], [ %.696, %B864.endif ]
  %scevgep5 = getelementptr i8, ptr %lsr.iv, i64 %17
  %exitcond196.not = icmp eq i64 %arg.count, %.526
  br i1 %exitcond196.not, label %B1048, label %B576

common.ret:
  %common.ret.op = phi i32 [ 0, %B1048 ], [ %.192, %B110.if.if ], [ %.735, %B864.endif.if.if ]
  ret i32 %common.ret.op

B1048:
  %over.2.0.lcssa = phi i64 [ 0, %B544.endif ], [ %over.3.1, %B1046 ]
  store i64 %over.2.0.lcssa, ptr %retptr, align 8
  br label %common.ret

B110.endif:
  %.213 = load i64, ptr %.175, align 8
  %.214 = getelementptr double, ptr %.181, i64 %.213
  %.215 = load double, ptr %.214, align 8
  %.219 = getelementptr i8, ptr %.214, i64 8
  %.220 = load double, ptr %.219, align 8
  %.9.i = call i32 @_ZN18biped_adrc_kernels4pushB3v81B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2add(ptr nonnull %.5.i1, ptr nonnull poison, ptr nonnull %.174, double %.215, double %.220) #0
  store i64 0, ptr %scevgep15, align 8
  br label %B354

B110.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret

B380.else.if:
  %.244 = add nsw i64 %arg.count, -1
  %4 = or i64 %.240, %.244
  %5 = icmp ult i64 %4, 4294967296
  br i1 %5, label %6, label %11

6:
  %7 = trunc nuw i64 %.240 to i32
  %8 = trunc nuw i64 %.244 to i32
  %9 = udiv i32 %8, %7
  %10 = zext i32 %9 to i64
  br label %15

11:
  %12 = sdiv i64 %.244, %.240
  %13 = srem i64 %.244, %.240
  %14 = ashr i64 %13, 63
  br label %15

15:
  %16 = phi i64 [ %10, %6 ], [ %12, %11 ]
  %.268.lobit = phi i64 [ 0, %6 ], [ %14, %11 ]
  %.255.1 = add i64 %.268.lobit, %16
  %.368175 = icmp sgt i64 %.255.1, -1
  br i1 %.368175, label %B442, label %B544.endif

B544.endif:
  %.513186.not = icmp slt i64 %arg.count, 1
  br i1 %.513186.not, label %B1048, label %B576.preheader

B576.preheader:
  %scevgep = getelementptr i8, ptr %arg.states, i64 16
  %17 = shl i64 %arg.width, 3
  br label %B576

B734.endif:
  %"$phi734.1.2.2" = phi i64 [ %.17.i, %B706 ], [ 0, %B602 ]
  %scevgep8 = getelementptr i8, ptr %arg.codes, i64 %2
  store i64 %"$phi734.1.2.2", ptr %scevgep8, align 8
  %.606 = load double, ptr %.575, align 8
  %.608 = fsub double %.606, %.577
  %.5.i = fptosi double %.608 to i64
  store i64 %.5.i, ptr %scevgep10, align 8
  %.643 = icmp sgt i64 %.5.i, 0
  br i1 %.643, label %B864.endif, label %B832

B864.endif:
  %"$phi864.4.2.2" = phi i64 [ 1, %B734.endif ], [ %3, %B832 ]
  %.696 = add nsw i64 %"$phi864.4.2.2", %over.2.0189
  %scevgep7 = getelementptr i8, ptr %lsr.iv, i64 -16
  %.709 = getelementptr i8, ptr %.570, i64 344
  %.711 = load double, ptr %.709, align 8
  %.715 = load double, ptr %.575, align 8
  store double %.711, ptr %scevgep7, align 8
  %scevgep6 = getelementptr i8, ptr %lsr.iv, i64 -8
  store double %.715, ptr %scevgep6, align 8
  %.722 = getelementptr i8, ptr %.570, i64 696
  %.723 = load i64, ptr %.722, align 8
  %.724 = inttoptr i64 %.723 to ptr
  %.727 = getelementptr i8, ptr %.570, i64 80
  %.728 = load i64, ptr %.727, align 8
  %.735 = call i32 @_ZN18biped_adrc_kernels4copyB2v4B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a10float64_2ax(ptr nonnull %.731, ptr nonnull %excinfo.4, ptr %.724, ptr %lsr.iv, i64 %.728)
  switch i32 %.735, label %B864.endif.if.if [
    i32 -2, label %B1046
    i32 0, label %B1046
  ], !prof !8

B864.endif.if.if:
  store ptr null, ptr %excinfo, align 8
  br label %common.ret
}


define i64 @samples(ptr readonly %.1, i64 %.2, i64 %.3, ptr readonly %.4, ptr writeonly %.5, ptr %.6, ptr %.7, ptr readonly %.8) local_unnamed_addr #0 {
entry:
  %.10 = alloca i64, align 8
  store i64 0, ptr %.10, align 8
  %excinfo = alloca ptr, align 8
  %.14 = call i32 @_ZN18biped_adrc_kernels7samplesB4v119B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axx10float64_2a10float64_2a8int64_2a8int64_2a8int64_2a(ptr nonnull %.10, ptr nonnull %excinfo, ptr %.1, i64 %.2, i64 %.3, ptr %.4, ptr %.5, ptr %.6, ptr %.7, ptr %.8) #0
  %cond = icmp eq i32 %.14, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !24

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.24 = load i64, ptr %.10, align 8
  ret i64 %.24
}


declare void @llvm.trap() #1


declare <4 x double> @llvm.fabs.v4f64(<4 x double>) #8





attributes #0 = { nounwind }
attributes #1 = { nounwind }
attributes #2 = { nounwind }
attributes #3 = { nounwind }
attributes #4 = { nounwind }
attributes #5 = { nounwind }
attributes #6 = { nounwind }
attributes #7 = { nounwind }
attributes #8 = { nounwind }
attributes #9 = { nounwind }

!0 = !{!1}
!1 = distinct !{!1, !2, !"_ZN18biped_adrc_kernels3addB2v2B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ad10float64_2a10float64_2ax: %retptr"}
!2 = distinct !{!2, !"_ZN18biped_adrc_kernels3addB2v2B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ad10float64_2a10float64_2ax"}
!3 = distinct !{!3, !4}
!4 = !{!"llvm.loop.unroll.disable"}
!5 = distinct !{!5, !6}
!6 = !{!"llvm.loop.isvectorized", i32 1}
!7 = distinct !{!7, !4}
!8 = !{!"branch_weights", i32 1, i32 49, i32 49}
!9 = !{!10, !12}
!10 = distinct !{!10, !11, !"_ZN18biped_adrc_kernels8set_timeB2v7B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad: %retptr"}
!11 = distinct !{!11, !"_ZN18biped_adrc_kernels8set_timeB2v7B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad"}
!12 = distinct !{!12, !13, !"_ZN18biped_adrc_kernels7disturbB2v6B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad: %retptr"}
!13 = distinct !{!13, !"_ZN18biped_adrc_kernels7disturbB2v6B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad"}
!14 = !{!12}
!15 = !{!16}
!16 = distinct !{!16, !17, !"_ZN18biped_adrc_kernels4noteB2v8B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad: %retptr"}
!17 = distinct !{!17, !"_ZN18biped_adrc_kernels4noteB2v8B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad"}
!18 = distinct !{!18, !6, !19}
!19 = !{!"llvm.loop.unroll.runtime.disable"}
!20 = !{!"branch_weights", i32 4, i32 12}
!21 = distinct !{!21, !6, !19}
!22 = distinct !{!22, !4}
!23 = distinct !{!23, !6}
!24 = !{!"branch_weights", i32 49, i32 1}
!25 = !{!26, !28}
!26 = distinct !{!26, !27, !"_ZN18biped_adrc_kernels8set_timeB2v7B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad: %retptr"}
!27 = distinct !{!27, !"_ZN18biped_adrc_kernels8set_timeB2v7B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad"}
!28 = distinct !{!28, !29, !"_ZN18biped_adrc_kernels7disturbB2v6B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad: %retptr"}
!29 = distinct !{!29, !"_ZN18biped_adrc_kernels7disturbB2v6B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad"}
!30 = !{!28}
!31 = !{!32}
!32 = distinct !{!32, !33, !"_ZN18biped_adrc_kernels4noteB2v8B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad: %retptr"}
!33 = distinct !{!33, !"_ZN18biped_adrc_kernels4noteB2v8B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad"}
!34 = !{!35, !37}
!35 = distinct !{!35, !36, !"_ZN18biped_adrc_kernels8set_timeB2v7B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad: %retptr"}
!36 = distinct !{!36, !"_ZN18biped_adrc_kernels8set_timeB2v7B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad"}
!37 = distinct !{!37, !38, !"_ZN18biped_adrc_kernels7disturbB2v6B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad: %retptr"}
!38 = distinct !{!38, !"_ZN18biped_adrc_kernels7disturbB2v6B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad"}
!39 = !{!37}
!40 = !{!41}
!41 = distinct !{!41, !42, !"_ZN18biped_adrc_kernels8set_timeB2v7B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad: %retptr"}
!42 = distinct !{!42, !"_ZN18biped_adrc_kernels8set_timeB2v7B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad"}
!43 = distinct !{!43, !4}
!44 = !{!45}
!45 = distinct !{!45, !46, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!46 = distinct !{!46, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!47 = !{!48}
!48 = distinct !{!48, !49, !"_ZN18biped_adrc_kernels4noteB2v8B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad: %retptr"}
!49 = distinct !{!49, !"_ZN18biped_adrc_kernels4noteB2v8B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ad"}
!50 = !{!51}
!51 = distinct !{!51, !52, !"_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax: %retptr"}
!52 = distinct !{!52, !"_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax"}
!53 = distinct !{!53, !6, !19}
!54 = distinct !{!54, !6, !19}
!55 = distinct !{!55, !19, !6}
!56 = !{!57}
!57 = distinct !{!57, !58, !"_ZN18biped_adrc_kernels6brokenB3v19B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!58 = distinct !{!58, !"_ZN18biped_adrc_kernels6brokenB3v19B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!59 = !{!60}
!60 = distinct !{!60, !61, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!61 = distinct !{!61, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!62 = !{!63, !65}
!63 = distinct !{!63, !64, !"_ZN18biped_adrc_kernels8set_timeB2v7B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad: %retptr"}
!64 = distinct !{!64, !"_ZN18biped_adrc_kernels8set_timeB2v7B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad"}
!65 = distinct !{!65, !66, !"_ZN18biped_adrc_kernels7disturbB2v6B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad: %retptr"}
!66 = distinct !{!66, !"_ZN18biped_adrc_kernels7disturbB2v6B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad"}
!67 = !{!65}
!68 = distinct !{!68, !4}
!69 = distinct !{!69, !4}
!70 = distinct !{!70, !6, !19}
!71 = distinct !{!71, !6, !19}
!72 = distinct !{!72, !4}
!73 = distinct !{!73, !6}
!74 = distinct !{!74, !6, !19}
!75 = distinct !{!75, !6, !19}
!76 = distinct !{!76, !4}
!77 = distinct !{!77, !6}
!78 = !{!79}
!79 = distinct !{!79, !80, !"_ZN18biped_adrc_kernels6matrixB3v27B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax23Literal_5bint_5d_280_29: %retptr"}
!80 = distinct !{!80, !"_ZN18biped_adrc_kernels6matrixB3v27B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax23Literal_5bint_5d_280_29"}
!81 = !{!82}
!82 = distinct !{!82, !83, !"_ZN18biped_adrc_kernels6matvecB3v30B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a10float64_2a: %retptr"}
!83 = distinct !{!83, !"_ZN18biped_adrc_kernels6matvecB3v30B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a10float64_2a"}
!84 = !{!85}
!85 = distinct !{!85, !86, !"_ZN18biped_adrc_kernels6matvecB3v30B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a10float64_2a: %retptr"}
!86 = distinct !{!86, !"_ZN18biped_adrc_kernels6matvecB3v30B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a10float64_2a"}
!87 = !{!88}
!88 = distinct !{!88, !89, !"_ZN18biped_adrc_kernels6matrixB3v32B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax23Literal_5bint_5d_282_29: %retptr"}
!89 = distinct !{!89, !"_ZN18biped_adrc_kernels6matrixB3v32B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax23Literal_5bint_5d_282_29"}
!90 = !{!91}
!91 = distinct !{!91, !92, !"_ZN18biped_adrc_kernels6matvecB3v30B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a10float64_2a: %retptr"}
!92 = distinct !{!92, !"_ZN18biped_adrc_kernels6matvecB3v30B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a10float64_2a"}
!93 = !{!94}
!94 = distinct !{!94, !95, !"_ZN18biped_adrc_kernels6matrixB3v33B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax23Literal_5bint_5d_283_29: %retptr"}
!95 = distinct !{!95, !"_ZN18biped_adrc_kernels6matrixB3v33B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax23Literal_5bint_5d_283_29"}
!96 = !{!97}
!97 = distinct !{!97, !98, !"_ZN18biped_adrc_kernels6matrixB3v34B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax23Literal_5bint_5d_285_29: %retptr"}
!98 = distinct !{!98, !"_ZN18biped_adrc_kernels6matrixB3v34B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ax23Literal_5bint_5d_285_29"}
!99 = distinct !{!99, !4}
!100 = distinct !{!100, !101}
!101 = !{!"llvm.loop.unswitch.partial.disable"}
!102 = !{!"branch_weights", i32 34359737, i32 2113123911}
!103 = !{!104}
!104 = distinct !{!104, !105, !"_ZN18biped_adrc_kernels4joinB3v36B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a: %retptr"}
!105 = distinct !{!105, !"_ZN18biped_adrc_kernels4joinB3v36B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a"}
!106 = !{!107}
!107 = distinct !{!107, !108, !"_ZN18biped_adrc_kernels4joinB3v36B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a: %retptr"}
!108 = distinct !{!108, !"_ZN18biped_adrc_kernels4joinB3v36B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a"}
!109 = !{!110}
!110 = distinct !{!110, !111, !"_ZN18biped_adrc_kernels5reachB3v39B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2ad: %retptr"}
!111 = distinct !{!111, !"_ZN18biped_adrc_kernels5reachB3v39B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2ad"}
!112 = !{!113}
!113 = distinct !{!113, !114, !"_ZN18biped_adrc_kernels5reachB3v39B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2ad: %retptr"}
!114 = distinct !{!114, !"_ZN18biped_adrc_kernels5reachB3v39B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2ad"}
!115 = !{}
!116 = !{!117}
!117 = distinct !{!117, !118, !"_ZN18biped_adrc_kernels5reachB3v39B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2ad: %retptr"}
!118 = distinct !{!118, !"_ZN18biped_adrc_kernels5reachB3v39B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2ad"}
!119 = !{!120}
!120 = distinct !{!120, !121, !"_ZN18biped_adrc_kernels5reachB3v39B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2ad: %retptr"}
!121 = distinct !{!121, !"_ZN18biped_adrc_kernels5reachB3v39B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2ad"}
!122 = distinct !{!122, !123}
!123 = !{!"llvm.loop.peeled.count", i32 1}
!124 = !{!125}
!125 = distinct !{!125, !126, !"_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd: %retptr"}
!126 = distinct !{!126, !"_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd"}
!127 = !{!128}
!128 = distinct !{!128, !129, !"_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax: %retptr"}
!129 = distinct !{!129, !"_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax"}
!130 = distinct !{!130, !6, !19}
!131 = distinct !{!131, !6, !19}
!132 = distinct !{!132, !19, !6}
!133 = !{!134}
!134 = distinct !{!134, !135, !"_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd: %retptr"}
!135 = distinct !{!135, !"_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd"}
!136 = !{!137}
!137 = distinct !{!137, !138, !"_ZN18biped_adrc_kernels6brokenB3v19B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!138 = distinct !{!138, !"_ZN18biped_adrc_kernels6brokenB3v19B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!139 = distinct !{!139, !123}
!140 = !{!141}
!141 = distinct !{!141, !142, !"_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd: %retptr"}
!142 = distinct !{!142, !"_ZN18biped_adrc_kernels7acceptsB3v44B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2axd"}
!143 = !{!144}
!144 = distinct !{!144, !145, !"_ZN18biped_adrc_kernels10begins_lowB3v53B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!145 = distinct !{!145, !"_ZN18biped_adrc_kernels10begins_lowB3v53B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!146 = distinct !{!146, !4}
!147 = distinct !{!147, !4}
!148 = !{!149}
!149 = distinct !{!149, !150, !"_ZN18biped_adrc_kernels4joinB3v36B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a: %retptr"}
!150 = distinct !{!150, !"_ZN18biped_adrc_kernels4joinB3v36B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a"}
!151 = !{!152}
!152 = distinct !{!152, !153, !"_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax: %retptr"}
!153 = distinct !{!153, !"_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax"}
!154 = distinct !{!154, !6, !19}
!155 = distinct !{!155, !6, !19}
!156 = distinct !{!156, !19, !6}
!157 = !{!158}
!158 = distinct !{!158, !159, !"_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax: %retptr"}
!159 = distinct !{!159, !"_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax"}
!160 = !{!161}
!161 = distinct !{!161, !162, !"_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax: %retptr"}
!162 = distinct !{!162, !"_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax"}
!163 = !{!164}
!164 = distinct !{!164, !165, !"_ZN18biped_adrc_kernels6brokenB3v19B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!165 = distinct !{!165, !"_ZN18biped_adrc_kernels6brokenB3v19B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!166 = !{!167}
!167 = distinct !{!167, !168, !"_ZN18biped_adrc_kernels6brokenB3v19B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!168 = distinct !{!168, !"_ZN18biped_adrc_kernels6brokenB3v19B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!169 = !{!170}
!170 = distinct !{!170, !171, !"_ZN18biped_adrc_kernels6brokenB3v19B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!171 = distinct !{!171, !"_ZN18biped_adrc_kernels6brokenB3v19B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!172 = distinct !{!172, !4}
!173 = !{!174}
!174 = distinct !{!174, !175, !"_ZN18biped_adrc_kernels5solveB3v64B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad: %retptr"}
!175 = distinct !{!175, !"_ZN18biped_adrc_kernels5solveB3v64B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad"}
!176 = !{!177}
!177 = distinct !{!177, !178, !"_ZN18biped_adrc_kernels4leftB3v59B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAEd: %retptr"}
!178 = distinct !{!178, !"_ZN18biped_adrc_kernels4leftB3v59B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAEd"}
!179 = !{!180}
!180 = distinct !{!180, !181, !"_ZN18biped_adrc_kernels4keepB3v63B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2a: %retptr"}
!181 = distinct !{!181, !"_ZN18biped_adrc_kernels4keepB3v63B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2a"}
!182 = !{!183}
!183 = distinct !{!183, !184, !"_ZN18biped_adrc_kernels5splitB3v62B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a: %retptr"}
!184 = distinct !{!184, !"_ZN18biped_adrc_kernels5splitB3v62B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a10float64_2a"}
!185 = !{!186}
!186 = distinct !{!186, !187, !"_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax: %retptr"}
!187 = distinct !{!187, !"_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax"}
!188 = distinct !{!188, !6, !19}
!189 = distinct !{!189, !6, !19}
!190 = distinct !{!190, !19, !6}
!191 = !{!192}
!192 = distinct !{!192, !193, !"_ZN18biped_adrc_kernels4leftB3v59B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAEd: %retptr"}
!193 = distinct !{!193, !"_ZN18biped_adrc_kernels4leftB3v59B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAEd"}
!194 = !{!195}
!195 = distinct !{!195, !196, !"_ZN18biped_adrc_kernels4keepB3v63B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2a: %retptr"}
!196 = distinct !{!196, !"_ZN18biped_adrc_kernels4keepB3v63B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2a"}
!197 = !{!198}
!198 = distinct !{!198, !199, !"_ZN18biped_adrc_kernels6brokenB3v19B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!199 = distinct !{!199, !"_ZN18biped_adrc_kernels6brokenB3v19B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!200 = !{!201}
!201 = distinct !{!201, !202, !"_ZN18biped_adrc_kernels3armB3v71B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!202 = distinct !{!202, !"_ZN18biped_adrc_kernels3armB3v71B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!203 = !{!204, !206}
!204 = distinct !{!204, !205, !"_ZN18biped_adrc_kernels6travelB3v72B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!205 = distinct !{!205, !"_ZN18biped_adrc_kernels6travelB3v72B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!206 = distinct !{!206, !205, !"_ZN18biped_adrc_kernels6travelB3v72B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %excinfo"}
!207 = distinct !{!207, !4}
!208 = !{!209}
!209 = distinct !{!209, !210, !"_ZN18biped_adrc_kernels4keepB3v63B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2a: %retptr"}
!210 = distinct !{!210, !"_ZN18biped_adrc_kernels4keepB3v63B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2ad10float64_2a10float64_2a"}
!211 = distinct !{!211, !4}
!212 = !{!213}
!213 = distinct !{!213, !214, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!214 = distinct !{!214, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!215 = !{!216}
!216 = distinct !{!216, !217, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!217 = distinct !{!217, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!218 = distinct !{!218, !4}
!219 = !{!220}
!220 = distinct !{!220, !221, !"_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax: %retptr"}
!221 = distinct !{!221, !"_ZN18biped_adrc_kernels6finiteB3v18B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax"}
!222 = distinct !{!222, !6, !19}
!223 = distinct !{!223, !6, !19}
!224 = distinct !{!224, !19, !6}
!225 = !{!226}
!226 = distinct !{!226, !227, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!227 = distinct !{!227, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!228 = !{!229}
!229 = distinct !{!229, !230, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!230 = distinct !{!230, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!231 = !{!232}
!232 = distinct !{!232, !233, !"_ZN18biped_adrc_kernels5looksB3v82B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axx8int64_2a10float64_2a: %retptr"}
!233 = distinct !{!233, !"_ZN18biped_adrc_kernels5looksB3v82B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2axx8int64_2a10float64_2a"}
!234 = !{!235}
!235 = distinct !{!235, !236, !"_ZN18biped_adrc_kernels9tick_timeB3v84B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!236 = distinct !{!236, !"_ZN18biped_adrc_kernels9tick_timeB3v84B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!237 = !{!238, !235}
!238 = distinct !{!238, !239, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!239 = distinct !{!239, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!240 = !{!241}
!241 = distinct !{!241, !242, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!242 = distinct !{!242, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!243 = !{!244, !246}
!244 = distinct !{!244, !245, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!245 = distinct !{!245, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!246 = distinct !{!246, !247, !"_ZN18biped_adrc_kernels9tick_timeB3v84B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!247 = distinct !{!247, !"_ZN18biped_adrc_kernels9tick_timeB3v84B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!248 = !{!249}
!249 = distinct !{!249, !250, !"_ZN18biped_adrc_kernels5stepsB3v86B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add: %retptr"}
!250 = distinct !{!250, !"_ZN18biped_adrc_kernels5stepsB3v86B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add"}
!251 = !{!252}
!252 = distinct !{!252, !253, !"_ZN18biped_adrc_kernels5stepsB3v86B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add: %retptr"}
!253 = distinct !{!253, !"_ZN18biped_adrc_kernels5stepsB3v86B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add"}
!254 = !{!255}
!255 = distinct !{!255, !256, !"_ZN18biped_adrc_kernels5stepsB3v86B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add: %retptr"}
!256 = distinct !{!256, !"_ZN18biped_adrc_kernels5stepsB3v86B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add"}
!257 = distinct !{!257, !4}
!258 = distinct !{!258, !4}
!259 = !{!260}
!260 = distinct !{!260, !261, !"_ZN18biped_adrc_kernels7part_ofB3v94B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_280_29: %retptr"}
!261 = distinct !{!261, !"_ZN18biped_adrc_kernels7part_ofB3v94B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_280_29"}
!262 = !{!263}
!263 = distinct !{!263, !264, !"_ZN18biped_adrc_kernels7part_ofB3v95B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_289_29: %retptr"}
!264 = distinct !{!264, !"_ZN18biped_adrc_kernels7part_ofB3v95B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_289_29"}
!265 = !{!266}
!266 = distinct !{!266, !267, !"_ZN18biped_adrc_kernels7part_ofB3v96B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2811_29: %retptr"}
!267 = distinct !{!267, !"_ZN18biped_adrc_kernels7part_ofB3v96B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2811_29"}
!268 = !{!269}
!269 = distinct !{!269, !270, !"_ZN18biped_adrc_kernels7part_ofB3v97B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2814_29: %retptr"}
!270 = distinct !{!270, !"_ZN18biped_adrc_kernels7part_ofB3v97B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2814_29"}
!271 = !{!272}
!272 = distinct !{!272, !273, !"_ZN18biped_adrc_kernels9tick_timeB3v84B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!273 = distinct !{!273, !"_ZN18biped_adrc_kernels9tick_timeB3v84B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!274 = !{!275, !272}
!275 = distinct !{!275, !276, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!276 = distinct !{!276, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!277 = !{!278}
!278 = distinct !{!278, !279, !"_ZN18biped_adrc_kernels12release_timeB3v89B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!279 = distinct !{!279, !"_ZN18biped_adrc_kernels12release_timeB3v89B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!280 = !{!281, !278}
!281 = distinct !{!281, !282, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a: %retptr"}
!282 = distinct !{!282, !"_ZN18biped_adrc_kernels11clock_startB3v14B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a"}
!283 = !{!284}
!284 = distinct !{!284, !285, !"_ZN18biped_adrc_kernels7part_ofB3v99B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_287_29: %retptr"}
!285 = distinct !{!285, !"_ZN18biped_adrc_kernels7part_ofB3v99B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_287_29"}
!286 = !{!287}
!287 = distinct !{!287, !288, !"_ZN18biped_adrc_kernels7part_ofB4v100B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_288_29: %retptr"}
!288 = distinct !{!288, !"_ZN18biped_adrc_kernels7part_ofB4v100B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_288_29"}
!289 = !{!290}
!290 = distinct !{!290, !291, !"_ZN18biped_adrc_kernels7part_ofB4v101B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2810_29: %retptr"}
!291 = distinct !{!291, !"_ZN18biped_adrc_kernels7part_ofB4v101B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2810_29"}
!292 = !{!293}
!293 = distinct !{!293, !294, !"_ZN18biped_adrc_kernels7part_ofB3v94B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_280_29: %retptr"}
!294 = distinct !{!294, !"_ZN18biped_adrc_kernels7part_ofB3v94B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_280_29"}
!295 = !{!296}
!296 = distinct !{!296, !297, !"_ZN18biped_adrc_kernels7part_ofB3v95B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_289_29: %retptr"}
!297 = distinct !{!297, !"_ZN18biped_adrc_kernels7part_ofB3v95B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_289_29"}
!298 = !{!299}
!299 = distinct !{!299, !300, !"_ZN18biped_adrc_kernels7part_ofB3v96B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2811_29: %retptr"}
!300 = distinct !{!300, !"_ZN18biped_adrc_kernels7part_ofB3v96B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2811_29"}
!301 = !{!302}
!302 = distinct !{!302, !303, !"_ZN18biped_adrc_kernels7part_ofB4v103B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_284_29: %retptr"}
!303 = distinct !{!303, !"_ZN18biped_adrc_kernels7part_ofB4v103B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_284_29"}
!304 = !{!305}
!305 = distinct !{!305, !306, !"_ZN18biped_adrc_kernels7part_ofB4v104B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_285_29: %retptr"}
!306 = distinct !{!306, !"_ZN18biped_adrc_kernels7part_ofB4v104B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_285_29"}
!307 = !{!308}
!308 = distinct !{!308, !309, !"_ZN18biped_adrc_kernels7part_ofB4v105B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_286_29: %retptr"}
!309 = distinct !{!309, !"_ZN18biped_adrc_kernels7part_ofB4v105B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_286_29"}
!310 = !{!311}
!311 = distinct !{!311, !312, !"_ZN18biped_adrc_kernels7part_ofB4v107B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ax: %retptr"}
!312 = distinct !{!312, !"_ZN18biped_adrc_kernels7part_ofB4v107B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ax"}
!313 = !{!314}
!314 = distinct !{!314, !315, !"_ZN18biped_adrc_kernels7part_ofB4v109B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2812_29: %retptr"}
!315 = distinct !{!315, !"_ZN18biped_adrc_kernels7part_ofB4v109B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2812_29"}
!316 = !{!317}
!317 = distinct !{!317, !318, !"_ZN18biped_adrc_kernels4leftB3v59B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAEd: %retptr"}
!318 = distinct !{!318, !"_ZN18biped_adrc_kernels4leftB3v59B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAEd"}
!319 = !{!320}
!320 = distinct !{!320, !321, !"_ZN18biped_adrc_kernels7part_ofB4v110B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_282_29: %retptr"}
!321 = distinct !{!321, !"_ZN18biped_adrc_kernels7part_ofB4v110B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_282_29"}
!322 = !{!323}
!323 = distinct !{!323, !324, !"_ZN18biped_adrc_kernels7part_ofB4v111B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_283_29: %retptr"}
!324 = distinct !{!324, !"_ZN18biped_adrc_kernels7part_ofB4v111B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_283_29"}
!325 = !{!326}
!326 = distinct !{!326, !327, !"_ZN18biped_adrc_kernels7part_ofB4v107B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ax: %retptr"}
!327 = distinct !{!327, !"_ZN18biped_adrc_kernels7part_ofB4v107B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2ax"}
!328 = !{!329}
!329 = distinct !{!329, !330, !"_ZN18biped_adrc_kernels7part_ofB4v110B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_282_29: %retptr"}
!330 = distinct !{!330, !"_ZN18biped_adrc_kernels7part_ofB4v110B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_282_29"}
!331 = !{!332}
!332 = distinct !{!332, !333, !"_ZN18biped_adrc_kernels7part_ofB3v97B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2814_29: %retptr"}
!333 = distinct !{!333, !"_ZN18biped_adrc_kernels7part_ofB3v97B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2814_29"}
!334 = !{!335}
!335 = distinct !{!335, !336, !"_ZN18biped_adrc_kernels7part_ofB4v113B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_281_29: %retptr"}
!336 = distinct !{!336, !"_ZN18biped_adrc_kernels7part_ofB4v113B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_281_29"}
!337 = !{!338}
!338 = distinct !{!338, !339, !"_ZN18biped_adrc_kernels7part_ofB4v111B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_283_29: %retptr"}
!339 = distinct !{!339, !"_ZN18biped_adrc_kernels7part_ofB4v111B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_283_29"}
!340 = !{!341}
!341 = distinct !{!341, !342, !"_ZN18biped_adrc_kernels7part_ofB3v97B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2814_29: %retptr"}
!342 = distinct !{!342, !"_ZN18biped_adrc_kernels7part_ofB3v97B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2814_29"}
!343 = !{!344}
!344 = distinct !{!344, !345, !"_ZN18biped_adrc_kernels7part_ofB4v110B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_282_29: %retptr"}
!345 = distinct !{!345, !"_ZN18biped_adrc_kernels7part_ofB4v110B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_282_29"}
!346 = !{!347}
!347 = distinct !{!347, !348, !"_ZN18biped_adrc_kernels5stepsB3v86B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add: %retptr"}
!348 = distinct !{!348, !"_ZN18biped_adrc_kernels5stepsB3v86B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add"}
!349 = !{!350}
!350 = distinct !{!350, !351, !"_ZN18biped_adrc_kernels5stepsB3v86B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add: %retptr"}
!351 = distinct !{!351, !"_ZN18biped_adrc_kernels5stepsB3v86B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add"}
!352 = !{!353}
!353 = distinct !{!353, !354, !"_ZN18biped_adrc_kernels7part_ofB3v94B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_280_29: %retptr"}
!354 = distinct !{!354, !"_ZN18biped_adrc_kernels7part_ofB3v94B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_280_29"}
!355 = !{!356}
!356 = distinct !{!356, !357, !"_ZN18biped_adrc_kernels7part_ofB4v100B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_288_29: %retptr"}
!357 = distinct !{!357, !"_ZN18biped_adrc_kernels7part_ofB4v100B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_288_29"}
!358 = !{!359}
!359 = distinct !{!359, !360, !"_ZN18biped_adrc_kernels7part_ofB3v99B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_287_29: %retptr"}
!360 = distinct !{!360, !"_ZN18biped_adrc_kernels7part_ofB3v99B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_287_29"}
!361 = !{!362}
!362 = distinct !{!362, !363, !"_ZN18biped_adrc_kernels5stepsB3v86B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add: %retptr"}
!363 = distinct !{!363, !"_ZN18biped_adrc_kernels5stepsB3v86B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2add"}
!364 = distinct !{!364, !4}
!365 = !{!366}
!366 = distinct !{!366, !367, !"_ZN18biped_adrc_kernels7part_ofB4v101B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2810_29: %retptr"}
!367 = distinct !{!367, !"_ZN18biped_adrc_kernels7part_ofB4v101B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2810_29"}
!368 = !{!369}
!369 = distinct !{!369, !370, !"_ZN18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax: %retptr"}
!370 = distinct !{!370, !"_ZN18biped_adrc_kernels3putB3v90B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE8int64_2ax10float64_2a10float64_2ax"}
!371 = !{!372}
!372 = distinct !{!372, !373, !"_ZN18biped_adrc_kernels7part_ofB4v113B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_281_29: %retptr"}
!373 = distinct !{!373, !"_ZN18biped_adrc_kernels7part_ofB4v113B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_281_29"}
!374 = !{!375}
!375 = distinct !{!375, !376, !"_ZN18biped_adrc_kernels7part_ofB3v97B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2814_29: %retptr"}
!376 = distinct !{!376, !"_ZN18biped_adrc_kernels7part_ofB3v97B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2814_29"}
!377 = distinct !{!377, !4}
!378 = !{!379}
!379 = distinct !{!379, !380, !"_ZN18biped_adrc_kernels7part_ofB4v118B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2815_29: %retptr"}
!380 = distinct !{!380, !"_ZN18biped_adrc_kernels7part_ofB4v118B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2815_29"}
!381 = !{!382}
!382 = distinct !{!382, !383, !"_ZN18biped_adrc_kernels7part_ofB4v113B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_281_29: %retptr"}
!383 = distinct !{!383, !"_ZN18biped_adrc_kernels7part_ofB4v113B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a23Literal_5bint_5d_281_29"}
!384 = !{!385}
!385 = distinct !{!385, !386, !"_ZN18biped_adrc_kernels7part_ofB3v97B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2814_29: %retptr"}
!386 = distinct !{!386, !"_ZN18biped_adrc_kernels7part_ofB3v97B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2814_29"}
!387 = distinct !{!387, !4}
!388 = !{!389}
!389 = distinct !{!389, !390, !"_ZN18biped_adrc_kernels7part_ofB4v118B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2815_29: %retptr"}
!390 = distinct !{!390, !"_ZN18biped_adrc_kernels7part_ofB4v118B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2815_29"}
!391 = !{!392}
!392 = distinct !{!392, !393, !"_ZN18biped_adrc_kernels7part_ofB4v101B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2810_29: %retptr"}
!393 = distinct !{!393, !"_ZN18biped_adrc_kernels7part_ofB4v101B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE8int64_2a10float64_2a24Literal_5bint_5d_2810_29"}
