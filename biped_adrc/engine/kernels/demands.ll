; sources 6d55c499d48507fd8dc19962c7290ab5, text 205fa0802ac65115998e935cb777fcc0


@_ZN08NumbaEnv18biped_adrc_kernels7demandsB4v121B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE10float64_2ax8int64_2ax8int64_2axx10float64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_min12_3clocals_3e4implB2v5B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dE15StarArgUniTupleIdLi2EE = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5loadsB4v122B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a8int64_2ax10float64_2a10float64_2ax = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_int12_3clocals_3e4implB3v88B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dEd = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_max12_3clocals_3e4implB3v87B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dE15StarArgUniTupleIdLi2EE = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_max12_3clocals_3e4implB3v60B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dE15StarArgUniTupleIdLi2EE = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6totalsB4v123B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE10float64_2ax8int64_2axx10float64_2a = weak local_unnamed_addr global ptr null


define i32 @_ZN18biped_adrc_kernels7demandsB4v121B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE10float64_2ax8int64_2ax8int64_2axx10float64_2a10float64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr readonly %arg.rows, i64 %arg.width, ptr readonly %arg.at, i64 %arg.p, ptr readonly %arg.first, i64 %arg.supports, i64 %arg.impacts, ptr readonly %arg.known, ptr %arg.out) local_unnamed_addr #0 {
B0.endif:
  %.674 = alloca ptr, align 8
  store ptr null, ptr %.674, align 8
  %excinfo.2 = alloca ptr, align 8
  store ptr null, ptr %excinfo.2, align 8
  %.30 = getelementptr i64, ptr %arg.first, i64 %arg.supports
  %.31 = load i64, ptr %.30, align 8
  %.33 = getelementptr i8, ptr %arg.at, i64 64
  %.34 = load i64, ptr %.33, align 8
  %.36 = getelementptr i8, ptr %arg.at, i64 56
  %.37 = load i64, ptr %.36, align 8
  %.61 = getelementptr double, ptr %arg.out, i64 %.31
  %.65.idx = shl i64 %.31, 4
  %.65 = getelementptr i8, ptr %arg.out, i64 %.65.idx
  %.79.idx = mul i64 %.31, 72
  %.79 = getelementptr i8, ptr %arg.out, i64 %.79.idx
  %.83.idx = mul i64 %.31, 80
  %.83 = getelementptr i8, ptr %arg.out, i64 %.83.idx
  %.106 = load double, ptr %arg.known, align 8
  %.108 = getelementptr i8, ptr %arg.known, i64 8
  %.109 = load double, ptr %.108, align 8
  %.111 = getelementptr i8, ptr %arg.known, i64 16
  %.112 = load double, ptr %.111, align 8
  %.123 = getelementptr i8, ptr %arg.known, i64 24
  %.124 = load double, ptr %.123, align 8
  %.126 = getelementptr i8, ptr %arg.known, i64 64
  %.127 = load double, ptr %.126, align 8
  %0 = getelementptr double, ptr %arg.known, i64 %arg.supports
  %.154 = getelementptr i8, ptr %0, i64 72
  %.240218.not = icmp slt i64 %arg.supports, 1
  br i1 %.240218.not, label %common.ret, label %B548.lr.ph

B548.lr.ph:
  %.377 = fsub double 1.000000e+00, %.124
  %.idx = mul i64 %.31, 24
  %1 = getelementptr i8, ptr %arg.out, i64 %.idx
  %2 = shl i64 %arg.width, 3
  %sunkaddr54 = getelementptr i8, ptr %arg.known, i64 48
  %sunkaddr55 = getelementptr i8, ptr %arg.known, i64 56
  %sunkaddr63 = getelementptr i8, ptr %arg.known, i64 32
  %sunkaddr64 = getelementptr i8, ptr %arg.known, i64 40
  br label %B548.endif

B546.loopexit:
  %before.2.1.lcssa = phi ptr [ %before.3.0221, %B548.endif ], [ %.564, %B2209 ]
  %pushed_x.2.1.lcssa = phi double [ %pushed_x.3.0222, %B548.endif ], [ %.599, %B2209 ]
  %pushed_z.2.1.lcssa = phi double [ %pushed_z.3.0223, %B548.endif ], [ %.618, %B2209 ]
  %exitcond.not = icmp eq i64 %.253, %arg.supports
  br i1 %exitcond.not, label %common.ret, label %B548.endif

B826:
  %above.2.1211 = phi i1 [ false, %B826.lr.ph ], [ %above.3.2, %B2209 ]
  %i.2.1210 = phi i64 [ %.284, %B826.lr.ph ], [ %i.3.2, %B2209 ]
  %pushed_z.2.1209 = phi double [ %pushed_z.3.0223, %B826.lr.ph ], [ %.618, %B2209 ]
  %pushed_x.2.1208 = phi double [ %pushed_x.3.0222, %B826.lr.ph ], [ %.599, %B2209 ]
  %before.2.1207 = phi ptr [ %before.3.0221, %B826.lr.ph ], [ %.564, %B2209 ]
  %.514202206 = phi i64 [ %.471, %B826.lr.ph ], [ %.524, %B2209 ]
  %.521203205 = phi i64 [ %.284, %B826.lr.ph ], [ %.528, %B2209 ]
  %.524 = add nsw i64 %.514202206, -1
  %.528 = add i64 %.521203205, 1
  %.562 = mul nsw i64 %.521203205, %arg.width
  %.564 = getelementptr double, ptr %arg.rows, i64 %.562
  %.570 = load double, ptr %.564, align 8
  %.575 = fsub double %.570, %.299
  %.581 = load double, ptr %before.2.1207, align 8
  %.582 = fsub double %.570, %.581
  %.583 = fmul double %.582, 5.000000e-01
  %.591 = getelementptr i8, ptr %.564, i64 16
  %.592 = load double, ptr %.591, align 8
  %.594 = getelementptr i8, ptr %before.2.1207, i64 16
  %.595 = load double, ptr %.594, align 8
  %.596 = fadd double %.592, %.595
  %.597 = fmul double %.583, %.596
  %.599 = fadd double %pushed_x.2.1208, %.597
  %.607 = getelementptr i8, ptr %.564, i64 24
  %.608 = load double, ptr %.607, align 8
  %.611 = getelementptr i8, ptr %before.2.1207, i64 24
  %.612 = load double, ptr %.611, align 8
  %.615 = fadd double %.608, %.612
  %.616 = fmul double %.583, %.615
  %.618 = fadd double %pushed_z.2.1209, %.616
  %.630 = getelementptr double, ptr %.564, i64 %.37
  %.631 = load double, ptr %.630, align 8
  %.633 = fsub double %.631, %.599
  %.637 = getelementptr i8, ptr %.630, i64 8
  %.638 = load double, ptr %.637, align 8
  %.640 = fsub double %.638, %.618
  %.643 = getelementptr double, ptr %.79, i64 %.521203205
  store double %.633, ptr %.643, align 8
  %.647 = getelementptr double, ptr %.83, i64 %.521203205
  store double %.640, ptr %.647, align 8
  %.652 = getelementptr double, ptr %arg.out, i64 %.521203205
  store double 0x7FF0000000000000, ptr %.652, align 8
  %.656 = getelementptr double, ptr %.61, i64 %.521203205
  store double 0xFFF0000000000000, ptr %.656, align 8
  %.660 = getelementptr double, ptr %.65, i64 %.521203205
  store double 0.000000e+00, ptr %.660, align 8
  %.668 = getelementptr double, ptr %1, i64 %.521203205
  store ptr null, ptr %.674, align 8
  %.678 = call i32 @_ZN18biped_adrc_kernels5loadsB4v122B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.674, ptr nonnull %excinfo.2, ptr nonnull %.564, ptr %arg.at, i64 %arg.p, ptr %.154, ptr %.668, i64 %.31)
  %cond = icmp eq i32 %.678, 0
  br i1 %cond, label %B826.endif, label %common.ret, !prof !0

B1394:
  %.717 = add nsw i64 %i.2.1210, 1
  %.719 = icmp slt i64 %.717, %.290
  br i1 %.719, label %B1412, label %B1524

B1412:
  %.733 = mul nsw i64 %.717, %arg.width
  %.735 = getelementptr double, ptr %arg.rows, i64 %.733
  %.736 = load double, ptr %.735, align 8
  %.739 = fsub double %.570, %.13.i
  %.740 = fcmp ugt double %.736, %.739
  br i1 %.740, label %B1524, label %B1454.preheader

B1454.preheader:
  %3 = add i64 %i.2.1210, 2
  %4 = mul i64 %3, %2
  %scevgep = getelementptr i8, ptr %arg.rows, i64 %4
  br label %B1454

B1454:
  %lsr.iv = phi ptr [ %scevgep, %B1454.preheader ], [ %scevgep49, %B1482 ]
  %i.5.4 = phi i64 [ %i.2.1210, %B1454.preheader ], [ %.746, %B1482 ]
  %5 = add i64 %i.5.4, 2
  %.758 = icmp slt i64 %5, %.290
  br i1 %.758, label %B1482, label %B1524.loopexit

B1482:
  %.746 = add i64 %i.5.4, 1
  %.774 = load double, ptr %lsr.iv, align 8
  %.778 = fcmp ugt double %.774, %.739
  %scevgep49 = getelementptr i8, ptr %lsr.iv, i64 %2
  br i1 %.778, label %B1524.loopexit, label %B1454

B1524.loopexit:
  %.746.lcssa = phi i64 [ %7, %B1454 ], [ %.746, %B1482 ]
  %.pre = add nsw i64 %.746.lcssa, 1
  br label %B1524

B1524:
  %.792.pre-phi = phi i64 [ %.pre, %B1524.loopexit ], [ %.717, %B1412 ], [ %.717, %B1394 ]
  %i.4.3 = phi i64 [ %.746.lcssa, %B1524.loopexit ], [ %i.2.1210, %B1412 ], [ %i.2.1210, %B1394 ]
  %.794 = mul nsw i64 %.792.pre-phi, %arg.width
  %.796 = getelementptr double, ptr %arg.rows, i64 %.794
  %.797 = load double, ptr %.796, align 8
  %.800 = mul nsw i64 %i.4.3, %arg.width
  %.802 = getelementptr double, ptr %arg.rows, i64 %.800
  %.803 = load double, ptr %.802, align 8
  %.804 = fsub double %.797, %.803
  %.824 = fcmp ogt double %.804, 0.000000e+00
  br i1 %.824, label %B1622.endif.endif, label %B1690

B1690:
  %"$phi1690.2.2.3" = phi double [ 0.000000e+00, %B1524 ], [ %.13.i21, %B1622.endif.endif ]
  %sunkaddr = shl i64 %.521203205, 3
  %sunkaddr51 = getelementptr i8, ptr %.79, i64 %sunkaddr
  %.912 = load double, ptr %sunkaddr51, align 8
  %.915 = getelementptr double, ptr %.79, i64 %i.4.3
  %.916 = load double, ptr %.915, align 8
  %.917 = fsub double %.912, %.916
  %.921 = getelementptr double, ptr %.79, i64 %.792.pre-phi
  %.922 = load double, ptr %.921, align 8
  %.927 = fsub double %.922, %.916
  %.928 = fmul double %"$phi1690.2.2.3", %.927
  %.929 = fsub double %.917, %.928
  %.934 = fdiv double %.929, %.13.i
  %sunkaddr53 = getelementptr i8, ptr %.83, i64 %sunkaddr
  %.941 = load double, ptr %sunkaddr53, align 8
  %.944 = getelementptr double, ptr %.83, i64 %i.4.3
  %.945 = load double, ptr %.944, align 8
  %.946 = fsub double %.941, %.945
  %.950 = getelementptr double, ptr %.83, i64 %.792.pre-phi
  %.951 = load double, ptr %.950, align 8
  %.956 = fsub double %.951, %.945
  %.957 = fmul double %"$phi1690.2.2.3", %.956
  %.958 = fsub double %.946, %.957
  %.963 = fdiv double %.958, %.13.i
  %.965 = fadd double %.109, %.963
  %.971 = load double, ptr %sunkaddr54, align 8
  %.973 = fmul double %.934, %.971
  %.976 = load double, ptr %sunkaddr55, align 8
  %.978 = fmul double %.976, %.965
  %.979 = fadd double %.973, %.978
  %sunkaddr57 = getelementptr i8, ptr %arg.out, i64 %sunkaddr
  store double %.979, ptr %sunkaddr57, align 8
  %.988 = fcmp ugt double %.979, 0.000000e+00
  br i1 %.988, label %B1950.endif, label %B2046

B2046:
  %i.3.2 = phi i64 [ %i.4.3, %B1690 ], [ %i.4.3, %B1950.endif ], [ %i.2.1210, %B826.endif ]
  %6 = getelementptr double, ptr %.564, i64 %.34
  %.1037 = getelementptr i8, ptr %6, i64 8
  %.1038 = load double, ptr %.1037, align 8
  %.1042 = load double, ptr %6, align 8
  %.1046 = fmul double %.112, %.1042
  %.1047 = fadd double %.1038, %.1046
  %.1052 = load double, ptr %sunkaddr60, align 8
  %.1053 = fadd double %.1052, %.1047
  %.1058 = fcmp ogt double %.1053, 0.000000e+00
  %above.2.1.not = xor i1 %above.2.1211, true
  %brmerge = or i1 %.1058, %above.2.1.not
  br i1 %brmerge, label %B2209, label %B2150

B2150:
  %.1076 = fcmp olt double %.365, %.575
  %.1086 = fcmp olt double %.575, %"$phi770.1.2.1"
  %or.cond185 = select i1 %.1076, i1 %.1086, i1 false
  br i1 %or.cond185, label %B2184, label %B2209

B2184:
  %.1104 = fsub double 0.000000e+00, %.1053
  %sunkaddr61 = shl i64 %.521203205, 3
  %sunkaddr62 = getelementptr inbounds i8, ptr %.65, i64 %sunkaddr61
  store double %.1104, ptr %sunkaddr62, align 8
  br label %B2209

common.ret:
  %excinfo.sink = phi ptr [ %retptr, %B0.endif ], [ %excinfo, %B826 ], [ %retptr, %B546.loopexit ]
  %common.ret.op = phi i32 [ 0, %B0.endif ], [ %.678, %B826 ], [ 0, %B546.loopexit ]
  store ptr null, ptr %excinfo.sink, align 8
  ret i32 %common.ret.op

B2209:
  %above.3.2 = phi i1 [ %.1058, %B2046 ], [ true, %B2150 ], [ true, %B2184 ]
  %.515 = icmp sgt i64 %.514202206, 1
  br i1 %.515, label %B826, label %B546.loopexit

B548.endif:
  %pushed_z.3.0223 = phi double [ 0.000000e+00, %B548.lr.ph ], [ %pushed_z.2.1.lcssa, %B546.loopexit ]
  %pushed_x.3.0222 = phi double [ 0.000000e+00, %B548.lr.ph ], [ %pushed_x.2.1.lcssa, %B546.loopexit ]
  %before.3.0221 = phi ptr [ %arg.rows, %B548.lr.ph ], [ %before.2.1.lcssa, %B546.loopexit ]
  %.246215219 = phi i64 [ 0, %B548.lr.ph ], [ %.253, %B546.loopexit ]
  %.253 = add nuw nsw i64 %.246215219, 1
  %.283 = getelementptr i64, ptr %arg.first, i64 %.246215219
  %.284 = load i64, ptr %.283, align 8
  %.288 = getelementptr i8, ptr %.283, i64 8
  %.289 = load i64, ptr %.288, align 8
  %.290 = add nsw i64 %.289, -1
  %.296 = mul nsw i64 %.284, %arg.width
  %.298 = getelementptr double, ptr %arg.rows, i64 %.296
  %.299 = load double, ptr %.298, align 8
  %.322 = mul nsw i64 %.290, %arg.width
  %.324 = getelementptr double, ptr %arg.rows, i64 %.322
  %.325 = load double, ptr %.324, align 8
  %.327 = fsub double %.325, %.299
  %.12.i = fcmp olt double %.327, %.106
  %.13.i = select i1 %.12.i, double %.327, double %.106
  %.363 = fmul double %.124, %.327
  %.365 = fadd double %.127, %.363
  %.374 = icmp slt i64 %.246215219, %arg.impacts
  %.379 = fmul double %.377, %.327
  %.383 = fsub double %.379, %.127
  %"$phi770.1.2.1" = select i1 %.374, double %.383, double 0x7FF0000000000000
  %.471 = sub i64 %.289, %.284
  %.515204.not = icmp slt i64 %.471, 1
  br i1 %.515204.not, label %B546.loopexit, label %B826.lr.ph

B826.lr.ph:
  %.706 = fsub double %.13.i, %.127
  %7 = add i64 %.289, -2
  %8 = fcmp ogt double %.13.i, 1.000000e-09
  %sunkaddr58 = shl i64 %.246215219, 3
  %sunkaddr59 = getelementptr i8, ptr %arg.known, i64 %sunkaddr58
  %sunkaddr60 = getelementptr i8, ptr %sunkaddr59, i64 72
  br label %B826

B826.endif:
  %.708 = fcmp oge double %.575, %.706
  %or.cond = select i1 %8, i1 %.708, i1 false
  br i1 %or.cond, label %B1394, label %B2046

B1622.endif.endif:
  %.807 = fsub double %.570, %.13.i
  %.816 = fsub double %.807, %.803
  %.831 = fdiv double %.816, %.804
  %.12.i18 = fcmp olt double %.831, 0.000000e+00
  %.13.i19 = select i1 %.12.i18, double 0.000000e+00, double %.831
  %.12.i20 = fcmp ogt double %.13.i19, 1.000000e+00
  %.13.i21 = select i1 %.12.i20, double 1.000000e+00, double %.13.i19
  br label %B1690

B1950.endif:
  %.997 = load double, ptr %sunkaddr63, align 8
  %.999 = fmul double %.934, %.997
  %.1004 = load double, ptr %sunkaddr64, align 8
  %.1006 = fmul double %.965, %.1004
  %.1009 = fadd double %.999, %.1006
  %.1010 = tail call double @llvm.fabs.f64(double %.1009)
  %.1018 = fdiv double %.1010, %.979
  %sunkaddr66 = getelementptr inbounds i8, ptr %.61, i64 %sunkaddr
  store double %.1018, ptr %sunkaddr66, align 8
  br label %B2046
}


declare double @llvm.fabs.f64(double) #1


define ptr @demands(ptr readonly %.1, i64 %.2, ptr readonly %.3, i64 %.4, ptr readonly %.5, i64 %.6, i64 %.7, ptr readonly %.8, ptr %.9) local_unnamed_addr #0 {
entry:
  %.11 = alloca ptr, align 8
  store ptr null, ptr %.11, align 8
  %excinfo = alloca ptr, align 8
  %.15 = call i32 @_ZN18biped_adrc_kernels7demandsB4v121B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE10float64_2ax8int64_2ax8int64_2axx10float64_2a10float64_2a(ptr nonnull %.11, ptr nonnull %excinfo, ptr %.1, i64 %.2, ptr %.3, i64 %.4, ptr %.5, i64 %.6, i64 %.7, ptr %.8, ptr %.9) #0
  %cond = icmp eq i32 %.15, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !0

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.25 = load ptr, ptr %.11, align 8
  ret ptr %.25
}


define void @numba_gil_ensure(ptr readnone %0) local_unnamed_addr #2 {
  tail call void @llvm.trap()
  unreachable
}


define noalias nonnull ptr @PyUnicode_FromString(ptr readnone %0) local_unnamed_addr #2 {
  tail call void @llvm.trap()
  unreachable
}


define void @PyErr_WriteUnraisable(ptr readnone %0) local_unnamed_addr #2 {
  tail call void @llvm.trap()
  unreachable
}


define void @Py_DecRef(ptr readnone %0) local_unnamed_addr #2 {
  tail call void @llvm.trap()
  unreachable
}


define void @numba_gil_release(ptr readnone %0) local_unnamed_addr #2 {
  tail call void @llvm.trap()
  unreachable
}


define void @PyErr_Clear() local_unnamed_addr #2 {
  tail call void @llvm.trap()
  unreachable
}


define noalias nonnull ptr @PyBytes_FromStringAndSize(ptr readnone %0, i64 %1) local_unnamed_addr #2 {
  tail call void @llvm.trap()
  unreachable
}


define noalias nonnull ptr @numba_unpickle(ptr readnone %0, i32 %1, ptr readnone %2) local_unnamed_addr #2 {
  tail call void @llvm.trap()
  unreachable
}


define void @PyErr_SetString(ptr readnone %0, ptr readnone %1) local_unnamed_addr #2 {
  tail call void @llvm.trap()
  unreachable
}


define noalias nonnull ptr @numba_runtime_build_excinfo_struct(ptr readnone %0, ptr readnone %1) local_unnamed_addr #2 {
  tail call void @llvm.trap()
  unreachable
}


define void @NRT_Free(ptr readnone %0) local_unnamed_addr #2 {
  tail call void @llvm.trap()
  unreachable
}


define void @numba_do_raise(ptr readnone %0) local_unnamed_addr #2 {
  tail call void @llvm.trap()
  unreachable
}


define void @PyErr_SetNone(ptr readnone %0) local_unnamed_addr #2 {
  tail call void @llvm.trap()
  unreachable
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels5loadsB4v122B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a8int64_2ax10float64_2a10float64_2ax(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.row, ptr readonly %arg.at, i64 %arg.p, ptr readonly %arg.joints, ptr initializes((0, 8)) %arg.out, i64 %arg.count) local_unnamed_addr #0 {
B0.endif.endif:
  store double 0.000000e+00, ptr %arg.out, align 8
  %.144.1 = getelementptr double, ptr %arg.out, i64 %arg.count
  store double 0.000000e+00, ptr %.144.1, align 8
  %.144.2.idx = shl i64 %arg.count, 4
  %.144.2 = getelementptr i8, ptr %arg.out, i64 %.144.2.idx
  store double 0.000000e+00, ptr %.144.2, align 8
  %.144.3.idx = mul i64 %arg.count, 24
  %.144.3 = getelementptr i8, ptr %arg.out, i64 %.144.3.idx
  store double 0.000000e+00, ptr %.144.3, align 8
  %.144.4.idx = shl i64 %arg.count, 5
  %.144.4 = getelementptr i8, ptr %arg.out, i64 %.144.4.idx
  store double 0.000000e+00, ptr %.144.4, align 8
  %.144.5.idx = mul i64 %arg.count, 40
  %.144.5 = getelementptr i8, ptr %arg.out, i64 %.144.5.idx
  store double 0.000000e+00, ptr %.144.5, align 8
  %.232194.not = icmp slt i64 %arg.p, 1
  br i1 %.232194.not, label %common.ret, label %B516.us.peel

common.ret:
  store ptr null, ptr %retptr, align 8
  ret i32 0

B516.us.peel:
  %.274 = getelementptr i8, ptr %arg.at, i64 8
  %.351 = getelementptr i8, ptr %arg.at, i64 32
  %.359 = getelementptr i8, ptr %arg.at, i64 40
  %.367 = getelementptr i8, ptr %arg.at, i64 48
  %.275.us.peel = load i64, ptr %.274, align 8
  %.277.us.peel = getelementptr double, ptr %arg.row, i64 %.275.us.peel
  %.278.us.peel = load double, ptr %.277.us.peel, align 8
  %.5.i = fptosi double %.278.us.peel to i64
  %0 = trunc i64 %.5.i to i1
  %1 = mul i64 %arg.p, 24
  %.349.idx.us.peel = select i1 %0, i64 %1, i64 0
  %.349.us.peel = getelementptr i8, ptr %arg.joints, i64 %.349.idx.us.peel
  %.352.us.peel = load i64, ptr %.351, align 8
  %2 = getelementptr double, ptr %arg.row, i64 %.352.us.peel
  %.357.us.peel = load double, ptr %2, align 8
  %.360.us.peel = load i64, ptr %.359, align 8
  %3 = getelementptr double, ptr %arg.row, i64 %.360.us.peel
  %.365.us.peel = load double, ptr %3, align 8
  %.368.us.peel = load i64, ptr %.367, align 8
  %4 = getelementptr double, ptr %arg.row, i64 %.368.us.peel
  %.373.us.peel = load double, ptr %4, align 8
  %.374.us.peel = getelementptr i8, ptr %.349.us.peel, i64 8
  %.375.us.peel = load double, ptr %.374.us.peel, align 8
  %.376.us.peel = fsub double %.375.us.peel, %.365.us.peel
  %.377.us.peel = getelementptr i8, ptr %.349.us.peel, i64 16
  %.378.us.peel = load double, ptr %.377.us.peel, align 8
  %.379.us.peel = fsub double %.365.us.peel, %.378.us.peel
  %.12.i = fcmp ogt double %.379.us.peel, %.376.us.peel
  %.13.i = select i1 %.12.i, double %.379.us.peel, double %.376.us.peel
  %.408.us.peel = tail call double @llvm.fabs.f64(double %.357.us.peel)
  %.409.us.peel = tail call double @llvm.fabs.f64(double %.373.us.peel)
  %.411.us.peel = load double, ptr %.349.us.peel, align 8
  %.415.us.peel = fdiv double %.409.us.peel, %.411.us.peel
  %.581.us.peel = load double, ptr %arg.out, align 8
  %.583.us.peel = fcmp ogt double %.408.us.peel, %.581.us.peel
  %.587.us.peel = fcmp uno double %.357.us.peel, 0.000000e+00
  %or.cond.us.peel = or i1 %.587.us.peel, %.583.us.peel
  br i1 %or.cond.us.peel, label %B566.us.peel, label %B516.us.1.peel

B566.us.peel:
  store double %.408.us.peel, ptr %arg.out, align 8
  store double 0.000000e+00, ptr %.144.3, align 8
  br label %B516.us.1.peel

B516.us.1.peel:
  %sunkaddr16 = shl i64 %arg.count, 3
  %sunkaddr17 = getelementptr i8, ptr %arg.out, i64 %sunkaddr16
  %.581.us.1.peel = load double, ptr %sunkaddr17, align 8
  %.583.us.1.peel = fcmp ogt double %.415.us.peel, %.581.us.1.peel
  %.587.us.1.peel = fcmp uno double %.415.us.peel, 0.000000e+00
  %or.cond.us.1.peel = or i1 %.587.us.1.peel, %.583.us.1.peel
  br i1 %or.cond.us.1.peel, label %B566.us.1.peel, label %B516.us.2.peel

B566.us.1.peel:
  store double %.415.us.peel, ptr %sunkaddr17, align 8
  store double 0.000000e+00, ptr %.144.4, align 8
  br label %B516.us.2.peel

B516.us.2.peel:
  %.581.us.2.peel = load double, ptr %.144.2, align 8
  %.583.us.2.peel = fcmp ogt double %.13.i, %.581.us.2.peel
  %.587.us.2.peel = fcmp uno double %.13.i, 0.000000e+00
  %or.cond.us.2.peel = or i1 %.587.us.2.peel, %.583.us.2.peel
  br i1 %or.cond.us.2.peel, label %B566.us.2.peel, label %B606.us.2.peel

B566.us.2.peel:
  store double %.13.i, ptr %.144.2, align 8
  store double 0.000000e+00, ptr %.144.5, align 8
  br label %B606.us.2.peel

B606.us.2.peel:
  %exitcond.peel.not = icmp eq i64 %arg.p, 1
  br i1 %exitcond.peel.not, label %common.ret, label %B516.us

B516.us:
  %.238183197.us = phi i64 [ %.245.us, %B606.us.2 ], [ 1, %B606.us.2.peel ]
  %.245.us = add nuw nsw i64 %.238183197.us, 1
  %.275.us = load i64, ptr %.274, align 8
  %.277.us = getelementptr double, ptr %arg.row, i64 %.275.us
  %.278.us = load double, ptr %.277.us, align 8
  %.5.i7 = fptosi double %.278.us to i64
  %5 = trunc i64 %.5.i7 to i1
  %.344.us = select i1 %5, i64 %arg.p, i64 0
  %6 = add nuw i64 %.344.us, %.238183197.us
  %.349.idx.us = mul i64 %6, 24
  %.349.us = getelementptr i8, ptr %arg.joints, i64 %.349.idx.us
  %.352.us = load i64, ptr %.351, align 8
  %7 = shl i64 %.352.us, 3
  %scevgep14 = getelementptr i8, ptr %arg.row, i64 %7
  %8 = shl i64 %.238183197.us, 3
  %scevgep15 = getelementptr i8, ptr %scevgep14, i64 %8
  %.357.us = load double, ptr %scevgep15, align 8
  %.360.us = load i64, ptr %.359, align 8
  %9 = shl i64 %.360.us, 3
  %scevgep12 = getelementptr i8, ptr %arg.row, i64 %9
  %scevgep2 = getelementptr i8, ptr %scevgep12, i64 %8
  %.365.us = load double, ptr %scevgep2, align 8
  %.368.us = load i64, ptr %.367, align 8
  %10 = shl i64 %.368.us, 3
  %scevgep = getelementptr i8, ptr %arg.row, i64 %10
  %scevgep1 = getelementptr i8, ptr %scevgep, i64 %8
  %.373.us = load double, ptr %scevgep1, align 8
  %.374.us = getelementptr i8, ptr %.349.us, i64 8
  %.375.us = load double, ptr %.374.us, align 8
  %.376.us = fsub double %.375.us, %.365.us
  %.377.us = getelementptr i8, ptr %.349.us, i64 16
  %.378.us = load double, ptr %.377.us, align 8
  %.379.us = fsub double %.365.us, %.378.us
  %.12.i8 = fcmp ogt double %.379.us, %.376.us
  %.13.i9 = select i1 %.12.i8, double %.379.us, double %.376.us
  %.408.us = tail call double @llvm.fabs.f64(double %.357.us)
  %.409.us = tail call double @llvm.fabs.f64(double %.373.us)
  %.411.us = load double, ptr %.349.us, align 8
  %.415.us = fdiv double %.409.us, %.411.us
  %.606.us = uitofp nneg i64 %.238183197.us to double
  %.581.us = load double, ptr %arg.out, align 8
  %.583.us = fcmp ogt double %.408.us, %.581.us
  %.587.us = fcmp uno double %.357.us, 0.000000e+00
  %or.cond.us = or i1 %.587.us, %.583.us
  br i1 %or.cond.us, label %B566.us, label %B516.us.1

B566.us:
  store double %.408.us, ptr %arg.out, align 8
  store double %.606.us, ptr %.144.3, align 8
  br label %B516.us.1

B516.us.1:
  %.581.us.1 = load double, ptr %sunkaddr17, align 8
  %.583.us.1 = fcmp ogt double %.415.us, %.581.us.1
  %.587.us.1 = fcmp uno double %.415.us, 0.000000e+00
  %or.cond.us.1 = or i1 %.587.us.1, %.583.us.1
  br i1 %or.cond.us.1, label %B566.us.1, label %B516.us.2

B566.us.1:
  store double %.415.us, ptr %sunkaddr17, align 8
  store double %.606.us, ptr %.144.4, align 8
  br label %B516.us.2

B516.us.2:
  %.581.us.2 = load double, ptr %.144.2, align 8
  %.583.us.2 = fcmp ogt double %.13.i9, %.581.us.2
  %.587.us.2 = fcmp uno double %.13.i9, 0.000000e+00
  %or.cond.us.2 = or i1 %.587.us.2, %.583.us.2
  br i1 %or.cond.us.2, label %B566.us.2, label %B606.us.2

B566.us.2:
  store double %.13.i9, ptr %.144.2, align 8
  store double %.606.us, ptr %.144.5, align 8
  br label %B606.us.2

B606.us.2:
  %exitcond.not = icmp eq i64 %arg.p, %.245.us
  br i1 %exitcond.not, label %common.ret, label %B516.us, !llvm.loop !1
}


define i32 @_ZN18biped_adrc_kernels6totalsB4v123B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE10float64_2ax8int64_2axx10float64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.rows, i64 %arg.width, ptr readonly %arg.at, i64 %arg.p, i64 %arg.count, ptr %arg.out) local_unnamed_addr #3 {
B0.endif:
  %.105164.not = icmp slt i64 %arg.count, 1
  br i1 %.105164.not, label %B820, label %B38.endif.lr.ph

B38.endif.lr.ph:
  %arg.p.fr = freeze i64 %arg.p
  %.216 = icmp sgt i64 %arg.p.fr, 0
  br i1 %.216, label %B38.endif.us.us.preheader, label %B38.endif.preheader

B38.endif.preheader:
  %xtraiter = and i64 %arg.count, 3
  %0 = icmp samesign ult i64 %arg.count, 4
  br i1 %0, label %B38.endif.preheader.B38.endif.epil.preheader_crit_edge, label %B38.endif.preheader.new

B38.endif.preheader.B38.endif.epil.preheader_crit_edge:
  %.pre = shl i64 %arg.width, 3
  br label %B38.endif.epil.preheader

B38.endif.preheader.new:
  %1 = mul i64 %arg.width, 24
  %2 = shl i64 %arg.width, 5
  %3 = shl i64 %arg.width, 4
  %4 = and i64 %arg.count, 9223372036854775804
  %sunkaddr130 = shl i64 %arg.width, 3
  %sunkaddr140 = getelementptr i8, ptr %arg.out, i64 8
  br label %B38.endif

B38.endif.us.us.preheader:
  %arg.out.promoted.us.us.pre = load double, ptr %arg.out, align 8
  %xtraiter8 = and i64 %arg.p.fr, 7
  %unroll_iter13 = and i64 %arg.p.fr, 9223372036854775800
  %xtraiter15 = and i64 %arg.p.fr, 3
  %unroll_iter19 = and i64 %arg.p.fr, 9223372036854775804
  %scevgep = getelementptr i8, ptr %arg.rows, i64 32
  %5 = shl i64 %arg.width, 3
  %scevgep43 = getelementptr i8, ptr %arg.rows, i64 16
  %scevgep54 = getelementptr i8, ptr %arg.rows, i64 24
  %6 = getelementptr i8, ptr %arg.rows, i64 %5
  %scevgep73 = getelementptr i8, ptr %6, i64 16
  %7 = shl nuw nsw i64 %xtraiter15, 3
  %8 = icmp samesign ult i64 %arg.p.fr, 8
  %sunkaddr = getelementptr i8, ptr %arg.at, i64 24
  %sunkaddr115 = getelementptr i8, ptr %arg.at, i64 32
  %sunkaddr116 = getelementptr i8, ptr %arg.at, i64 40
  %9 = icmp eq i64 %xtraiter8, 0
  %10 = icmp samesign ult i64 %arg.p.fr, 4
  %sunkaddr117 = getelementptr i8, ptr %arg.out, i64 8
  %sunkaddr118 = getelementptr i8, ptr %arg.out, i64 16
  %sunkaddr119 = getelementptr i8, ptr %arg.out, i64 24
  %sunkaddr120 = getelementptr i8, ptr %arg.out, i64 32
  %sunkaddr121 = getelementptr i8, ptr %arg.out, i64 40
  %11 = icmp eq i64 %xtraiter15, 0
  br label %B38.endif.us.us

B38.endif.us.us:
  %arg.rows.pn = phi ptr [ %arg.rows, %B38.endif.us.us.preheader ], [ %lsr.iv90, %B816.us.us ]
  %lsr.iv74 = phi ptr [ %scevgep73, %B38.endif.us.us.preheader ], [ %scevgep75, %B816.us.us ]
  %lsr.iv55 = phi ptr [ %scevgep54, %B38.endif.us.us.preheader ], [ %scevgep56, %B816.us.us ]
  %lsr.iv44 = phi ptr [ %scevgep43, %B38.endif.us.us.preheader ], [ %scevgep45, %B816.us.us ]
  %lsr.iv = phi ptr [ %scevgep, %B38.endif.us.us.preheader ], [ %scevgep22, %B816.us.us ]
  %arg.out.promoted.us.us = phi double [ %arg.out.promoted.us.us.pre, %B38.endif.us.us.preheader ], [ %arg.out.promoted.us.us257.lcssa, %B816.us.us ]
  %.111153167.us.us = phi i64 [ 0, %B38.endif.us.us.preheader ], [ %.118.us.us, %B816.us.us ]
  %lsr.iv90 = getelementptr i8, ptr %arg.rows.pn, i64 %5
  %.148.us.us = mul nsw i64 %.111153167.us.us, %arg.width
  %.150.us.us = getelementptr double, ptr %arg.rows, i64 %.148.us.us
  %.156.us.us = load i64, ptr %sunkaddr, align 8
  %.161.us.us = load i64, ptr %sunkaddr115, align 8
  %.166.us.us = load i64, ptr %sunkaddr116, align 8
  br i1 %8, label %B272.us.us.epil.preheader, label %B272.us.us.preheader

B272.us.us.preheader:
  %12 = shl i64 %.156.us.us, 3
  %scevgep23 = getelementptr i8, ptr %lsr.iv, i64 %12
  br label %B272.us.us

B440.us.us:
  %.346.us.us = getelementptr double, ptr %.150.us.us, i64 %arg.width
  %.347.us.us = load double, ptr %.346.us.us, align 8
  %.350.us.us = load double, ptr %.150.us.us, align 8
  %.353.us.us = fcmp ogt double %.347.us.us, %.350.us.us
  br i1 %.353.us.us, label %B476.endif.us.us, label %B816.us.us

B476.endif.us.us:
  %.357.us.us = load double, ptr %sunkaddr117, align 8
  %.358.us.us = fadd double %.357.us.us, 1.000000e+00
  store double %.358.us.us, ptr %sunkaddr117, align 8
  %.494.promoted.us.us = load double, ptr %sunkaddr118, align 8
  %.508.promoted.us.us = load double, ptr %sunkaddr119, align 8
  %.522.promoted.us.us = load double, ptr %sunkaddr120, align 8
  %.530.promoted.us.us = load double, ptr %sunkaddr121, align 8
  br i1 %10, label %B540.us.us.epil.preheader, label %B540.us.us.preheader

B540.us.us.preheader:
  %13 = shl i64 %.166.us.us, 3
  %scevgep46 = getelementptr i8, ptr %lsr.iv44, i64 %13
  %14 = shl i64 %.156.us.us, 3
  %scevgep57 = getelementptr i8, ptr %lsr.iv55, i64 %14
  %15 = shl i64 %.161.us.us, 3
  %scevgep65 = getelementptr i8, ptr %lsr.iv44, i64 %15
  %scevgep76 = getelementptr i8, ptr %lsr.iv74, i64 %13
  br label %B540.us.us

B816.us.us.loopexit.unr-lcssa:
  br i1 %11, label %B816.us.us, label %B540.us.us.epil.preheader

B540.us.us.epil.preheader:
  %.531151.us.us.epil.init = phi double [ %.530.promoted.us.us, %B476.endif.us.us ], [ %.532.us.us.3, %B816.us.us.loopexit.unr-lcssa ]
  %.523150.us.us.epil.init = phi double [ %.522.promoted.us.us, %B476.endif.us.us ], [ %.525.us.us.3, %B816.us.us.loopexit.unr-lcssa ]
  %.509149.us.us.epil.init = phi double [ %.508.promoted.us.us, %B476.endif.us.us ], [ %.517.us.us.3, %B816.us.us.loopexit.unr-lcssa ]
  %.495148.us.us.epil.init = phi double [ %.494.promoted.us.us, %B476.endif.us.us ], [ %.503.us.us.3, %B816.us.us.loopexit.unr-lcssa ]
  %.448142144.us.us.epil.init = phi i64 [ 0, %B476.endif.us.us ], [ %unroll_iter19, %B816.us.us.loopexit.unr-lcssa ]
  %16 = add i64 %.448142144.us.us.epil.init, %.156.us.us
  %17 = shl i64 %16, 3
  %scevgep84 = getelementptr i8, ptr %arg.rows.pn, i64 %17
  %18 = add i64 %.448142144.us.us.epil.init, %.166.us.us
  %19 = shl i64 %18, 3
  %scevgep87 = getelementptr i8, ptr %arg.rows.pn, i64 %19
  %scevgep92 = getelementptr i8, ptr %lsr.iv90, i64 %19
  %20 = add i64 %.448142144.us.us.epil.init, %.161.us.us
  %21 = shl i64 %20, 3
  %scevgep94 = getelementptr i8, ptr %arg.rows.pn, i64 %21
  br label %B540.us.us.epil

B540.us.us.epil:
  %lsr.iv85 = phi i64 [ %lsr.iv.next, %B540.us.us.epil ], [ 0, %B540.us.us.epil.preheader ]
  %.531151.us.us.epil = phi double [ %.532.us.us.epil, %B540.us.us.epil ], [ %.531151.us.us.epil.init, %B540.us.us.epil.preheader ]
  %.523150.us.us.epil = phi double [ %.525.us.us.epil, %B540.us.us.epil ], [ %.523150.us.us.epil.init, %B540.us.us.epil.preheader ]
  %.509149.us.us.epil = phi double [ %.517.us.us.epil, %B540.us.us.epil ], [ %.509149.us.us.epil.init, %B540.us.us.epil.preheader ]
  %.495148.us.us.epil = phi double [ %.503.us.us.epil, %B540.us.us.epil ], [ %.495148.us.us.epil.init, %B540.us.us.epil.preheader ]
  %scevgep95 = getelementptr i8, ptr %scevgep94, i64 %lsr.iv85
  %.482.us.us.epil = load double, ptr %scevgep95, align 8
  %scevgep93 = getelementptr i8, ptr %scevgep92, i64 %lsr.iv85
  %.487.us.us.epil = load double, ptr %scevgep93, align 8
  %scevgep88 = getelementptr i8, ptr %scevgep87, i64 %lsr.iv85
  %.490.us.us.epil = load double, ptr %scevgep88, align 8
  %.491.us.us.epil = fsub double %.487.us.us.epil, %.490.us.us.epil
  %.492.us.us.epil = fmul double %.482.us.us.epil, %.491.us.us.epil
  %scevgep86 = getelementptr i8, ptr %scevgep84, i64 %lsr.iv85
  %.498.us.us.epil = load double, ptr %scevgep86, align 8
  %.502.us.us.epil = fmul double %.498.us.us.epil, %.498.us.us.epil
  %.503.us.us.epil = fadd double %.495148.us.us.epil, %.502.us.us.epil
  store double %.503.us.us.epil, ptr %sunkaddr118, align 8
  %.512.us.us.epil = load double, ptr %scevgep95, align 8
  %.516.us.us.epil = fmul double %.512.us.us.epil, %.512.us.us.epil
  %.517.us.us.epil = fadd double %.509149.us.us.epil, %.516.us.us.epil
  store double %.517.us.us.epil, ptr %sunkaddr119, align 8
  %.524.us.us.epil = tail call double @llvm.fabs.f64(double %.492.us.us.epil)
  %.525.us.us.epil = fadd double %.523150.us.us.epil, %.524.us.us.epil
  store double %.525.us.us.epil, ptr %sunkaddr120, align 8
  %.532.us.us.epil = fadd double %.531151.us.us.epil, %.492.us.us.epil
  store double %.532.us.us.epil, ptr %sunkaddr121, align 8
  %lsr.iv.next = add nuw nsw i64 %lsr.iv85, 8
  %epil.iter16.cmp.not = icmp eq i64 %7, %lsr.iv.next
  br i1 %epil.iter16.cmp.not, label %B816.us.us, label %B540.us.us.epil, !llvm.loop !3

B816.us.us:
  %scevgep22 = getelementptr i8, ptr %lsr.iv, i64 %5
  %scevgep45 = getelementptr i8, ptr %lsr.iv44, i64 %5
  %scevgep56 = getelementptr i8, ptr %lsr.iv55, i64 %5
  %scevgep75 = getelementptr i8, ptr %lsr.iv74, i64 %5
  %exitcond256.not = icmp eq i64 %arg.count, %.118.us.us
  br i1 %exitcond256.not, label %B820, label %B38.endif.us.us

B540.us.us:
  %.531151.us.us = phi double [ %.532.us.us.3, %B540.us.us ], [ %.530.promoted.us.us, %B540.us.us.preheader ]
  %.523150.us.us = phi double [ %.525.us.us.3, %B540.us.us ], [ %.522.promoted.us.us, %B540.us.us.preheader ]
  %.509149.us.us = phi double [ %.517.us.us.3, %B540.us.us ], [ %.508.promoted.us.us, %B540.us.us.preheader ]
  %.495148.us.us = phi double [ %.503.us.us.3, %B540.us.us ], [ %.494.promoted.us.us, %B540.us.us.preheader ]
  %.448142144.us.us = phi i64 [ %.455.us.us.3, %B540.us.us ], [ 0, %B540.us.us.preheader ]
  %22 = shl i64 %.448142144.us.us, 3
  %scevgep67 = getelementptr i8, ptr %scevgep65, i64 %22
  %scevgep68 = getelementptr i8, ptr %scevgep67, i64 -16
  %.482.us.us = load double, ptr %scevgep68, align 8
  %scevgep78 = getelementptr i8, ptr %scevgep76, i64 %22
  %scevgep79 = getelementptr i8, ptr %scevgep78, i64 -16
  %.487.us.us = load double, ptr %scevgep79, align 8
  %scevgep50 = getelementptr i8, ptr %scevgep46, i64 %22
  %scevgep51 = getelementptr i8, ptr %scevgep50, i64 -16
  %.490.us.us = load double, ptr %scevgep51, align 8
  %.491.us.us = fsub double %.487.us.us, %.490.us.us
  %.492.us.us = fmul double %.482.us.us, %.491.us.us
  %scevgep59 = getelementptr i8, ptr %scevgep57, i64 %22
  %scevgep60 = getelementptr i8, ptr %scevgep59, i64 -24
  %.498.us.us = load double, ptr %scevgep60, align 8
  %.502.us.us = fmul double %.498.us.us, %.498.us.us
  %.503.us.us = fadd double %.495148.us.us, %.502.us.us
  store double %.503.us.us, ptr %sunkaddr118, align 8
  %.512.us.us = load double, ptr %scevgep68, align 8
  %.516.us.us = fmul double %.512.us.us, %.512.us.us
  %.517.us.us = fadd double %.509149.us.us, %.516.us.us
  store double %.517.us.us, ptr %sunkaddr119, align 8
  %.524.us.us = tail call double @llvm.fabs.f64(double %.492.us.us)
  %.525.us.us = fadd double %.523150.us.us, %.524.us.us
  store double %.525.us.us, ptr %sunkaddr120, align 8
  %.532.us.us = fadd double %.531151.us.us, %.492.us.us
  store double %.532.us.us, ptr %sunkaddr121, align 8
  %scevgep72 = getelementptr i8, ptr %scevgep67, i64 -8
  %.482.us.us.1 = load double, ptr %scevgep72, align 8
  %scevgep83 = getelementptr i8, ptr %scevgep78, i64 -8
  %.487.us.us.1 = load double, ptr %scevgep83, align 8
  %scevgep53 = getelementptr i8, ptr %scevgep50, i64 -8
  %.490.us.us.1 = load double, ptr %scevgep53, align 8
  %.491.us.us.1 = fsub double %.487.us.us.1, %.490.us.us.1
  %.492.us.us.1 = fmul double %.482.us.us.1, %.491.us.us.1
  %scevgep64 = getelementptr i8, ptr %scevgep59, i64 -16
  %.498.us.us.1 = load double, ptr %scevgep64, align 8
  %.502.us.us.1 = fmul double %.498.us.us.1, %.498.us.us.1
  %.503.us.us.1 = fadd double %.503.us.us, %.502.us.us.1
  store double %.503.us.us.1, ptr %sunkaddr118, align 8
  %.512.us.us.1 = load double, ptr %scevgep72, align 8
  %.516.us.us.1 = fmul double %.512.us.us.1, %.512.us.us.1
  %.517.us.us.1 = fadd double %.517.us.us, %.516.us.us.1
  store double %.517.us.us.1, ptr %sunkaddr119, align 8
  %.524.us.us.1 = tail call double @llvm.fabs.f64(double %.492.us.us.1)
  %.525.us.us.1 = fadd double %.525.us.us, %.524.us.us.1
  store double %.525.us.us.1, ptr %sunkaddr120, align 8
  %.532.us.us.1 = fadd double %.532.us.us, %.492.us.us.1
  store double %.532.us.us.1, ptr %sunkaddr121, align 8
  %.482.us.us.2 = load double, ptr %scevgep67, align 8
  %.487.us.us.2 = load double, ptr %scevgep78, align 8
  %.490.us.us.2 = load double, ptr %scevgep50, align 8
  %.491.us.us.2 = fsub double %.487.us.us.2, %.490.us.us.2
  %.492.us.us.2 = fmul double %.482.us.us.2, %.491.us.us.2
  %scevgep62 = getelementptr i8, ptr %scevgep59, i64 -8
  %.498.us.us.2 = load double, ptr %scevgep62, align 8
  %.502.us.us.2 = fmul double %.498.us.us.2, %.498.us.us.2
  %.503.us.us.2 = fadd double %.503.us.us.1, %.502.us.us.2
  store double %.503.us.us.2, ptr %sunkaddr118, align 8
  %.512.us.us.2 = load double, ptr %scevgep67, align 8
  %.516.us.us.2 = fmul double %.512.us.us.2, %.512.us.us.2
  %.517.us.us.2 = fadd double %.517.us.us.1, %.516.us.us.2
  store double %.517.us.us.2, ptr %sunkaddr119, align 8
  %.524.us.us.2 = tail call double @llvm.fabs.f64(double %.492.us.us.2)
  %.525.us.us.2 = fadd double %.525.us.us.1, %.524.us.us.2
  store double %.525.us.us.2, ptr %sunkaddr120, align 8
  %.532.us.us.2 = fadd double %.532.us.us.1, %.492.us.us.2
  store double %.532.us.us.2, ptr %sunkaddr121, align 8
  %.455.us.us.3 = add nuw nsw i64 %.448142144.us.us, 4
  %scevgep70 = getelementptr i8, ptr %scevgep67, i64 8
  %.482.us.us.3 = load double, ptr %scevgep70, align 8
  %scevgep81 = getelementptr i8, ptr %scevgep78, i64 8
  %.487.us.us.3 = load double, ptr %scevgep81, align 8
  %scevgep49 = getelementptr i8, ptr %scevgep50, i64 8
  %.490.us.us.3 = load double, ptr %scevgep49, align 8
  %.491.us.us.3 = fsub double %.487.us.us.3, %.490.us.us.3
  %.492.us.us.3 = fmul double %.482.us.us.3, %.491.us.us.3
  %.498.us.us.3 = load double, ptr %scevgep59, align 8
  %.502.us.us.3 = fmul double %.498.us.us.3, %.498.us.us.3
  %.503.us.us.3 = fadd double %.503.us.us.2, %.502.us.us.3
  store double %.503.us.us.3, ptr %sunkaddr118, align 8
  %.512.us.us.3 = load double, ptr %scevgep70, align 8
  %.516.us.us.3 = fmul double %.512.us.us.3, %.512.us.us.3
  %.517.us.us.3 = fadd double %.517.us.us.2, %.516.us.us.3
  store double %.517.us.us.3, ptr %sunkaddr119, align 8
  %.524.us.us.3 = tail call double @llvm.fabs.f64(double %.492.us.us.3)
  %.525.us.us.3 = fadd double %.525.us.us.2, %.524.us.us.3
  store double %.525.us.us.3, ptr %sunkaddr120, align 8
  %.532.us.us.3 = fadd double %.532.us.us.2, %.492.us.us.3
  store double %.532.us.us.3, ptr %sunkaddr121, align 8
  %niter20.ncmp.3 = icmp eq i64 %unroll_iter19, %.455.us.us.3
  br i1 %niter20.ncmp.3, label %B816.us.us.loopexit.unr-lcssa, label %B540.us.us

B272.us.us:
  %arg.out.promoted.us.us258 = phi double [ %arg.out.promoted.us.us257.7, %B420.us.us.7 ], [ %arg.out.promoted.us.us, %B272.us.us.preheader ]
  %.303140.us.us = phi double [ %.303139.us.us.7, %B420.us.us.7 ], [ %arg.out.promoted.us.us, %B272.us.us.preheader ]
  %.264134136.us.us = phi i64 [ %.271.us.us.7, %B420.us.us.7 ], [ 0, %B272.us.us.preheader ]
  %23 = shl i64 %.264134136.us.us, 3
  %scevgep25 = getelementptr i8, ptr %scevgep23, i64 %23
  %scevgep26 = getelementptr i8, ptr %scevgep25, i64 -32
  %.302.us.us = load double, ptr %scevgep26, align 8
  %.303.us.us = tail call double @llvm.fabs.f64(double %.302.us.us)
  %.307.us.us = fcmp ogt double %.303.us.us, %.303140.us.us
  %.317.us.us = fcmp uno double %.302.us.us, 0.000000e+00
  %or.cond.us.us = select i1 %.307.us.us, i1 true, i1 %.317.us.us
  br i1 %or.cond.us.us, label %B372.us.us, label %B420.us.us

B372.us.us:
  store double %.303.us.us, ptr %arg.out, align 8
  br label %B420.us.us

B420.us.us:
  %arg.out.promoted.us.us257 = phi double [ %arg.out.promoted.us.us258, %B272.us.us ], [ %.303.us.us, %B372.us.us ]
  %.303139.us.us = phi double [ %.303140.us.us, %B272.us.us ], [ %.303.us.us, %B372.us.us ]
  %scevgep34 = getelementptr i8, ptr %scevgep25, i64 -24
  %.302.us.us.1 = load double, ptr %scevgep34, align 8
  %.303.us.us.1 = tail call double @llvm.fabs.f64(double %.302.us.us.1)
  %.307.us.us.1 = fcmp ogt double %.303.us.us.1, %.303139.us.us
  %.317.us.us.1 = fcmp uno double %.302.us.us.1, 0.000000e+00
  %or.cond.us.us.1 = select i1 %.307.us.us.1, i1 true, i1 %.317.us.us.1
  br i1 %or.cond.us.us.1, label %B372.us.us.1, label %B420.us.us.1

B372.us.us.1:
  store double %.303.us.us.1, ptr %arg.out, align 8
  br label %B420.us.us.1

B420.us.us.1:
  %arg.out.promoted.us.us257.1 = phi double [ %arg.out.promoted.us.us257, %B420.us.us ], [ %.303.us.us.1, %B372.us.us.1 ]
  %.303139.us.us.1 = phi double [ %.303139.us.us, %B420.us.us ], [ %.303.us.us.1, %B372.us.us.1 ]
  %scevgep36 = getelementptr i8, ptr %scevgep25, i64 -16
  %.302.us.us.2 = load double, ptr %scevgep36, align 8
  %.303.us.us.2 = tail call double @llvm.fabs.f64(double %.302.us.us.2)
  %.307.us.us.2 = fcmp ogt double %.303.us.us.2, %.303139.us.us.1
  %.317.us.us.2 = fcmp uno double %.302.us.us.2, 0.000000e+00
  %or.cond.us.us.2 = select i1 %.307.us.us.2, i1 true, i1 %.317.us.us.2
  br i1 %or.cond.us.us.2, label %B372.us.us.2, label %B420.us.us.2

B372.us.us.2:
  store double %.303.us.us.2, ptr %arg.out, align 8
  br label %B420.us.us.2

B420.us.us.2:
  %arg.out.promoted.us.us257.2 = phi double [ %arg.out.promoted.us.us257.1, %B420.us.us.1 ], [ %.303.us.us.2, %B372.us.us.2 ]
  %.303139.us.us.2 = phi double [ %.303139.us.us.1, %B420.us.us.1 ], [ %.303.us.us.2, %B372.us.us.2 ]
  %scevgep38 = getelementptr i8, ptr %scevgep25, i64 -8
  %.302.us.us.3 = load double, ptr %scevgep38, align 8
  %.303.us.us.3 = tail call double @llvm.fabs.f64(double %.302.us.us.3)
  %.307.us.us.3 = fcmp ogt double %.303.us.us.3, %.303139.us.us.2
  %.317.us.us.3 = fcmp uno double %.302.us.us.3, 0.000000e+00
  %or.cond.us.us.3 = select i1 %.307.us.us.3, i1 true, i1 %.317.us.us.3
  br i1 %or.cond.us.us.3, label %B372.us.us.3, label %B420.us.us.3

B372.us.us.3:
  store double %.303.us.us.3, ptr %arg.out, align 8
  br label %B420.us.us.3

B420.us.us.3:
  %arg.out.promoted.us.us257.3 = phi double [ %arg.out.promoted.us.us257.2, %B420.us.us.2 ], [ %.303.us.us.3, %B372.us.us.3 ]
  %.303139.us.us.3 = phi double [ %.303139.us.us.2, %B420.us.us.2 ], [ %.303.us.us.3, %B372.us.us.3 ]
  %.302.us.us.4 = load double, ptr %scevgep25, align 8
  %.303.us.us.4 = tail call double @llvm.fabs.f64(double %.302.us.us.4)
  %.307.us.us.4 = fcmp ogt double %.303.us.us.4, %.303139.us.us.3
  %.317.us.us.4 = fcmp uno double %.302.us.us.4, 0.000000e+00
  %or.cond.us.us.4 = select i1 %.307.us.us.4, i1 true, i1 %.317.us.us.4
  br i1 %or.cond.us.us.4, label %B372.us.us.4, label %B420.us.us.4

B372.us.us.4:
  store double %.303.us.us.4, ptr %arg.out, align 8
  br label %B420.us.us.4

B420.us.us.4:
  %arg.out.promoted.us.us257.4 = phi double [ %arg.out.promoted.us.us257.3, %B420.us.us.3 ], [ %.303.us.us.4, %B372.us.us.4 ]
  %.303139.us.us.4 = phi double [ %.303139.us.us.3, %B420.us.us.3 ], [ %.303.us.us.4, %B372.us.us.4 ]
  %scevgep32 = getelementptr i8, ptr %scevgep25, i64 8
  %.302.us.us.5 = load double, ptr %scevgep32, align 8
  %.303.us.us.5 = tail call double @llvm.fabs.f64(double %.302.us.us.5)
  %.307.us.us.5 = fcmp ogt double %.303.us.us.5, %.303139.us.us.4
  %.317.us.us.5 = fcmp uno double %.302.us.us.5, 0.000000e+00
  %or.cond.us.us.5 = select i1 %.307.us.us.5, i1 true, i1 %.317.us.us.5
  br i1 %or.cond.us.us.5, label %B372.us.us.5, label %B420.us.us.5

B372.us.us.5:
  store double %.303.us.us.5, ptr %arg.out, align 8
  br label %B420.us.us.5

B420.us.us.5:
  %arg.out.promoted.us.us257.5 = phi double [ %arg.out.promoted.us.us257.4, %B420.us.us.4 ], [ %.303.us.us.5, %B372.us.us.5 ]
  %.303139.us.us.5 = phi double [ %.303139.us.us.4, %B420.us.us.4 ], [ %.303.us.us.5, %B372.us.us.5 ]
  %scevgep30 = getelementptr i8, ptr %scevgep25, i64 16
  %.302.us.us.6 = load double, ptr %scevgep30, align 8
  %.303.us.us.6 = tail call double @llvm.fabs.f64(double %.302.us.us.6)
  %.307.us.us.6 = fcmp ogt double %.303.us.us.6, %.303139.us.us.5
  %.317.us.us.6 = fcmp uno double %.302.us.us.6, 0.000000e+00
  %or.cond.us.us.6 = select i1 %.307.us.us.6, i1 true, i1 %.317.us.us.6
  br i1 %or.cond.us.us.6, label %B372.us.us.6, label %B420.us.us.6

B372.us.us.6:
  store double %.303.us.us.6, ptr %arg.out, align 8
  br label %B420.us.us.6

B420.us.us.6:
  %arg.out.promoted.us.us257.6 = phi double [ %arg.out.promoted.us.us257.5, %B420.us.us.5 ], [ %.303.us.us.6, %B372.us.us.6 ]
  %.303139.us.us.6 = phi double [ %.303139.us.us.5, %B420.us.us.5 ], [ %.303.us.us.6, %B372.us.us.6 ]
  %.271.us.us.7 = add nuw nsw i64 %.264134136.us.us, 8
  %scevgep28 = getelementptr i8, ptr %scevgep25, i64 24
  %.302.us.us.7 = load double, ptr %scevgep28, align 8
  %.303.us.us.7 = tail call double @llvm.fabs.f64(double %.302.us.us.7)
  %.307.us.us.7 = fcmp ogt double %.303.us.us.7, %.303139.us.us.6
  %.317.us.us.7 = fcmp uno double %.302.us.us.7, 0.000000e+00
  %or.cond.us.us.7 = select i1 %.307.us.us.7, i1 true, i1 %.317.us.us.7
  br i1 %or.cond.us.us.7, label %B372.us.us.7, label %B420.us.us.7

B372.us.us.7:
  store double %.303.us.us.7, ptr %arg.out, align 8
  br label %B420.us.us.7

B420.us.us.7:
  %arg.out.promoted.us.us257.7 = phi double [ %arg.out.promoted.us.us257.6, %B420.us.us.6 ], [ %.303.us.us.7, %B372.us.us.7 ]
  %.303139.us.us.7 = phi double [ %.303139.us.us.6, %B420.us.us.6 ], [ %.303.us.us.7, %B372.us.us.7 ]
  %niter14.ncmp.7 = icmp eq i64 %unroll_iter13, %.271.us.us.7
  br i1 %niter14.ncmp.7, label %B270.B422_crit_edge.us.us.unr-lcssa, label %B272.us.us

B270.B422_crit_edge.us.us.unr-lcssa:
  br i1 %9, label %B270.B422_crit_edge.us.us, label %B272.us.us.epil.preheader

B272.us.us.epil.preheader:
  %arg.out.promoted.us.us258.epil.init = phi double [ %arg.out.promoted.us.us, %B38.endif.us.us ], [ %arg.out.promoted.us.us257.7, %B270.B422_crit_edge.us.us.unr-lcssa ]
  %.303140.us.us.epil.init = phi double [ %arg.out.promoted.us.us, %B38.endif.us.us ], [ %.303139.us.us.7, %B270.B422_crit_edge.us.us.unr-lcssa ]
  %.264134136.us.us.epil.init = phi i64 [ 0, %B38.endif.us.us ], [ %unroll_iter13, %B270.B422_crit_edge.us.us.unr-lcssa ]
  %24 = add i64 %.264134136.us.us.epil.init, %.156.us.us
  %25 = shl i64 %24, 3
  %scevgep41 = getelementptr i8, ptr %arg.rows.pn, i64 %25
  br label %B272.us.us.epil

B272.us.us.epil:
  %arg.out.promoted.us.us258.epil = phi double [ %arg.out.promoted.us.us258.epil.init, %B272.us.us.epil.preheader ], [ %arg.out.promoted.us.us257.epil, %B420.us.us.epil ]
  %.303140.us.us.epil = phi double [ %.303140.us.us.epil.init, %B272.us.us.epil.preheader ], [ %.303139.us.us.epil, %B420.us.us.epil ]
  %epil.iter9 = phi i64 [ 0, %B272.us.us.epil.preheader ], [ %epil.iter9.next, %B420.us.us.epil ]
  %26 = shl nuw nsw i64 %epil.iter9, 3
  %scevgep42 = getelementptr i8, ptr %scevgep41, i64 %26
  %.302.us.us.epil = load double, ptr %scevgep42, align 8
  %.303.us.us.epil = tail call double @llvm.fabs.f64(double %.302.us.us.epil)
  %.307.us.us.epil = fcmp ogt double %.303.us.us.epil, %.303140.us.us.epil
  %.317.us.us.epil = fcmp uno double %.302.us.us.epil, 0.000000e+00
  %or.cond.us.us.epil = select i1 %.307.us.us.epil, i1 true, i1 %.317.us.us.epil
  br i1 %or.cond.us.us.epil, label %B372.us.us.epil, label %B420.us.us.epil

B372.us.us.epil:
  store double %.303.us.us.epil, ptr %arg.out, align 8
  br label %B420.us.us.epil

B420.us.us.epil:
  %arg.out.promoted.us.us257.epil = phi double [ %arg.out.promoted.us.us258.epil, %B272.us.us.epil ], [ %.303.us.us.epil, %B372.us.us.epil ]
  %.303139.us.us.epil = phi double [ %.303140.us.us.epil, %B272.us.us.epil ], [ %.303.us.us.epil, %B372.us.us.epil ]
  %epil.iter9.next = add i64 %epil.iter9, 1
  %epil.iter9.cmp.not = icmp eq i64 %xtraiter8, %epil.iter9.next
  br i1 %epil.iter9.cmp.not, label %B270.B422_crit_edge.us.us, label %B272.us.us.epil, !llvm.loop !5

B270.B422_crit_edge.us.us:
  %arg.out.promoted.us.us257.lcssa = phi double [ %arg.out.promoted.us.us257.7, %B270.B422_crit_edge.us.us.unr-lcssa ], [ %arg.out.promoted.us.us257.epil, %B420.us.us.epil ]
  %.118.us.us = add nuw nsw i64 %.111153167.us.us, 1
  %.342.us.us = icmp slt i64 %.118.us.us, %arg.count
  br i1 %.342.us.us, label %B440.us.us, label %B816.us.us

B440:
  %sunkaddr131 = getelementptr i8, ptr %lsr.iv106, i64 %sunkaddr130
  %.347 = load double, ptr %sunkaddr131, align 8
  %.350 = load double, ptr %lsr.iv106, align 8
  %.353 = fcmp ogt double %.347, %.350
  br i1 %.353, label %B476.endif, label %B816

B816:
  %.342.1 = icmp slt i64 %lsr.iv104, %arg.count
  br i1 %.342.1, label %B440.1, label %B816.1

B440.1:
  %scevgep112 = getelementptr i8, ptr %lsr.iv106, i64 %3
  %.347.1 = load double, ptr %scevgep112, align 8
  %sunkaddr133 = getelementptr i8, ptr %lsr.iv106, i64 %sunkaddr130
  %.350.1 = load double, ptr %sunkaddr133, align 8
  %.353.1 = fcmp ogt double %.347.1, %.350.1
  br i1 %.353.1, label %B476.endif.1, label %B816.1

B476.endif.1:
  %.357.1 = load double, ptr %sunkaddr140, align 8
  %.358.1 = fadd double %.357.1, 1.000000e+00
  store double %.358.1, ptr %sunkaddr140, align 8
  br label %B816.1

B816.1:
  %27 = or disjoint i64 %lsr.iv104, 1
  %.342.2 = icmp slt i64 %27, %arg.count
  br i1 %.342.2, label %B440.2, label %B816.2

B440.2:
  %scevgep111 = getelementptr i8, ptr %lsr.iv106, i64 %3
  %scevgep109 = getelementptr i8, ptr %lsr.iv106, i64 %1
  %.347.2 = load double, ptr %scevgep109, align 8
  %.350.2 = load double, ptr %scevgep111, align 8
  %.353.2 = fcmp ogt double %.347.2, %.350.2
  br i1 %.353.2, label %B476.endif.2, label %B816.2

B476.endif.2:
  %.357.2 = load double, ptr %sunkaddr140, align 8
  %.358.2 = fadd double %.357.2, 1.000000e+00
  store double %.358.2, ptr %sunkaddr140, align 8
  br label %B816.2

B816.2:
  %28 = add nuw nsw i64 %lsr.iv104, 2
  %.342.3 = icmp slt i64 %28, %arg.count
  br i1 %.342.3, label %B440.3, label %B816.3

B440.3:
  %scevgep108 = getelementptr i8, ptr %lsr.iv106, i64 %1
  %scevgep110 = getelementptr i8, ptr %lsr.iv106, i64 %2
  %.347.3 = load double, ptr %scevgep110, align 8
  %.350.3 = load double, ptr %scevgep108, align 8
  %.353.3 = fcmp ogt double %.347.3, %.350.3
  br i1 %.353.3, label %B476.endif.3, label %B816.3

B476.endif.3:
  %.357.3 = load double, ptr %sunkaddr140, align 8
  %.358.3 = fadd double %.357.3, 1.000000e+00
  store double %.358.3, ptr %sunkaddr140, align 8
  br label %B816.3

B816.3:
  %lsr.iv.next105 = add nuw nsw i64 %lsr.iv104, 4
  %scevgep107 = getelementptr i8, ptr %lsr.iv106, i64 %2
  %29 = sub nsw i64 %lsr.iv.next105, %4
  %niter.ncmp.3 = icmp eq i64 %29, 2
  br i1 %niter.ncmp.3, label %B820.loopexit6.unr-lcssa, label %B38.endif

B820.loopexit6.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B820, label %B38.endif.epil.preheader

B38.endif.epil.preheader:
  %.pre-phi = phi i64 [ %.pre, %B38.endif.preheader.B38.endif.epil.preheader_crit_edge ], [ %sunkaddr130, %B820.loopexit6.unr-lcssa ]
  %.111153167.epil.init = phi i64 [ 0, %B38.endif.preheader.B38.endif.epil.preheader_crit_edge ], [ %4, %B820.loopexit6.unr-lcssa ]
  %30 = shl i64 %.111153167.epil.init, 3
  %31 = or disjoint i64 %30, 8
  %32 = mul i64 %31, %arg.width
  %factor.op.mul = mul i64 %arg.width, %.111153167.epil.init
  %.reass = shl i64 %factor.op.mul, 3
  %sunkaddr139 = getelementptr i8, ptr %arg.out, i64 8
  br label %B38.endif.epil

B38.endif.epil:
  %lsr.iv102 = phi i64 [ %lsr.iv.next103, %B816.epil ], [ %xtraiter, %B38.endif.epil.preheader ]
  %lsr.iv100.in = phi i64 [ %lsr.iv100, %B816.epil ], [ %.111153167.epil.init, %B38.endif.epil.preheader ]
  %lsr.iv96 = phi ptr [ %scevgep97, %B816.epil ], [ %arg.rows, %B38.endif.epil.preheader ]
  %lsr.iv100 = add nuw i64 %lsr.iv100.in, 1
  %.342.epil = icmp slt i64 %lsr.iv100, %arg.count
  br i1 %.342.epil, label %B440.epil, label %B816.epil

B440.epil:
  %scevgep99 = getelementptr i8, ptr %lsr.iv96, i64 %32
  %.347.epil = load double, ptr %scevgep99, align 8
  %sunkaddr138 = getelementptr i8, ptr %lsr.iv96, i64 %.reass
  %.350.epil = load double, ptr %sunkaddr138, align 8
  %.353.epil = fcmp ogt double %.347.epil, %.350.epil
  br i1 %.353.epil, label %B476.endif.epil, label %B816.epil

B476.endif.epil:
  %.357.epil = load double, ptr %sunkaddr139, align 8
  %.358.epil = fadd double %.357.epil, 1.000000e+00
  store double %.358.epil, ptr %sunkaddr139, align 8
  br label %B816.epil

B816.epil:
  %scevgep97 = getelementptr i8, ptr %lsr.iv96, i64 %.pre-phi
  %lsr.iv.next103 = add nsw i64 %lsr.iv102, -1
  %epil.iter.cmp.not = icmp eq i64 %lsr.iv.next103, 0
  br i1 %epil.iter.cmp.not, label %B820, label %B38.endif.epil, !llvm.loop !6

B820:
  store ptr null, ptr %retptr, align 8
  ret i32 0

B38.endif:
  %lsr.iv106 = phi ptr [ %scevgep107, %B816.3 ], [ %arg.rows, %B38.endif.preheader.new ]
  %lsr.iv104 = phi i64 [ %lsr.iv.next105, %B816.3 ], [ 2, %B38.endif.preheader.new ]
  %.342.not = icmp sgt i64 %lsr.iv104, %arg.count
  br i1 %.342.not, label %B816, label %B440

B476.endif:
  %.357 = load double, ptr %sunkaddr140, align 8
  %.358 = fadd double %.357, 1.000000e+00
  store double %.358, ptr %sunkaddr140, align 8
  br label %B816
}


define ptr @totals(ptr readonly %.1, i64 %.2, ptr readonly %.3, i64 %.4, i64 %.5, ptr %.6) local_unnamed_addr #4 {
entry:
  %.8 = alloca ptr, align 8
  store ptr null, ptr %.8, align 8
  %.12 = call i32 @_ZN18biped_adrc_kernels6totalsB4v123B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE10float64_2ax8int64_2axx10float64_2a(ptr nonnull %.8, ptr nonnull poison, ptr %.1, i64 %.2, ptr %.3, i64 %.4, i64 %.5, ptr %.6) #0
  %.22 = load ptr, ptr %.8, align 8
  ret ptr %.22
}


declare void @llvm.trap() #2

attributes #0 = { nounwind }
attributes #1 = { nounwind }
attributes #2 = { nounwind }
attributes #3 = { nounwind }
attributes #4 = { nounwind }

!0 = !{!"branch_weights", i32 49, i32 1}
!1 = distinct !{!1, !2}
!2 = !{!"llvm.loop.peeled.count", i32 1}
!3 = distinct !{!3, !4}
!4 = !{!"llvm.loop.unroll.disable"}
!5 = distinct !{!5, !4}
!6 = distinct !{!6, !4}
