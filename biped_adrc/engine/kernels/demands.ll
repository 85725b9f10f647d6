; sources 457fd958418ffa588e295018f247f416, text 68e4f776bafcff8e02c2114e98859b55


@_ZN08NumbaEnv18biped_adrc_kernels5edgesB4v121B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE10float64_2ax8int64_2axx8int64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels7demandsB4v122B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE10float64_2ax8int64_2ax8int64_2axx10float64_2a10float64_2a10float64_2a = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_min12_3clocals_3e4implB2v5B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dE15StarArgUniTupleIdLi2EE = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels5loadsB4v123B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a8int64_2ax10float64_2a10float64_2ax = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_int12_3clocals_3e4implB3v88B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dEd = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_max12_3clocals_3e4implB3v87B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dE15StarArgUniTupleIdLi2EE = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv5numba7cpython8builtins6ol_max12_3clocals_3e4implB3v60B54c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAw4hWqFpgsIBZmgA_3dE15StarArgUniTupleIdLi2EE = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels10keep_worstB4v124B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax10float64_2ab = weak local_unnamed_addr global ptr null
@_ZN08NumbaEnv18biped_adrc_kernels6totalsB4v125B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE10float64_2ax8int64_2axx10float64_2a = weak local_unnamed_addr global ptr null


define i32 @_ZN18biped_adrc_kernels5edgesB4v121B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE10float64_2ax8int64_2axx8int64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.rows, i64 %arg.width, ptr readonly %arg.at, i64 %arg.count, i64 %arg.supports, ptr writeonly %arg.first) local_unnamed_addr #0 {
B0.endif:
  %.10788.not = icmp slt i64 %arg.supports, 1
  br i1 %.10788.not, label %B216, label %B40.lr.ph

B40.lr.ph:
  %xtraiter = and i64 %arg.supports, 3
  %0 = icmp samesign ult i64 %arg.supports, 4
  br i1 %0, label %B40.epil.preheader, label %B40.lr.ph.new

B40.lr.ph.new:
  %unroll_iter = and i64 %arg.supports, 9223372036854775804
  %sunkaddr = getelementptr i8, ptr %arg.at, i64 8
  br label %B40

B40:
  %low.2.091 = phi i64 [ 0, %B40.lr.ph.new ], [ %low.3.2.3, %B204.3 ]
  %.1138789 = phi i64 [ 0, %B40.lr.ph.new ], [ %.120.3, %B204.3 ]
  %.120 = or disjoint i64 %.1138789, 1
  %.158 = load i64, ptr %sunkaddr, align 8
  %.160 = getelementptr double, ptr %arg.rows, i64 %.158
  %.161 = load double, ptr %.160, align 8
  %.163 = uitofp nneg i64 %.1138789 to double
  %.164 = fadd double %.161, %.163
  %.173 = icmp slt i64 %low.2.091, %arg.count
  br i1 %.173, label %B102.else.if, label %B204

B204:
  %low.3.2 = phi i64 [ %low.2.091, %B40 ], [ %low.4.3, %B102.else.if ]
  %.304 = getelementptr i64, ptr %arg.first, i64 %.1138789
  store i64 %low.3.2, ptr %.304, align 8
  %.120.1 = or disjoint i64 %.1138789, 2
  %.158.1 = load i64, ptr %sunkaddr, align 8
  %.160.1 = getelementptr double, ptr %arg.rows, i64 %.158.1
  %.161.1 = load double, ptr %.160.1, align 8
  %.163.1 = uitofp nneg i64 %.120 to double
  %.164.1 = fadd double %.161.1, %.163.1
  %.173.1 = icmp slt i64 %low.3.2, %arg.count
  br i1 %.173.1, label %B102.else.if.1, label %B204.1

B102.else.if.1:
  %low.5.1.1 = phi i64 [ %low.4.3.1, %B102.else.if.1 ], [ %low.3.2, %B204 ]
  %high.2.1.1 = phi i64 [ %high.3.3.1, %B102.else.if.1 ], [ %arg.count, %B204 ]
  %.184.1 = add nuw nsw i64 %high.2.1.1, %low.5.1.1
  %.192.1.1 = lshr i64 %.184.1, 1
  %.230.1 = mul nsw i64 %.192.1.1, %arg.width
  %gep.1 = getelementptr double, ptr %.160.1, i64 %.230.1
  %.237.1 = load double, ptr %gep.1, align 8
  %.239.1 = fcmp olt double %.237.1, %.164.1
  %.250.1 = add nuw nsw i64 %.192.1.1, 1
  %high.3.3.1 = select i1 %.239.1, i64 %high.2.1.1, i64 %.192.1.1
  %low.4.3.1 = select i1 %.239.1, i64 %.250.1, i64 %low.5.1.1
  %.281.1 = icmp slt i64 %low.4.3.1, %high.3.3.1
  br i1 %.281.1, label %B102.else.if.1, label %B204.1

B204.1:
  %low.3.2.1 = phi i64 [ %low.3.2, %B204 ], [ %low.4.3.1, %B102.else.if.1 ]
  %.304.1 = getelementptr i64, ptr %arg.first, i64 %.120
  store i64 %low.3.2.1, ptr %.304.1, align 8
  %.120.2 = or disjoint i64 %.1138789, 3
  %.158.2 = load i64, ptr %sunkaddr, align 8
  %.160.2 = getelementptr double, ptr %arg.rows, i64 %.158.2
  %.161.2 = load double, ptr %.160.2, align 8
  %.163.2 = uitofp nneg i64 %.120.1 to double
  %.164.2 = fadd double %.161.2, %.163.2
  %.173.2 = icmp slt i64 %low.3.2.1, %arg.count
  br i1 %.173.2, label %B102.else.if.2, label %B204.2

B102.else.if.2:
  %low.5.1.2 = phi i64 [ %low.4.3.2, %B102.else.if.2 ], [ %low.3.2.1, %B204.1 ]
  %high.2.1.2 = phi i64 [ %high.3.3.2, %B102.else.if.2 ], [ %arg.count, %B204.1 ]
  %.184.2 = add nuw nsw i64 %high.2.1.2, %low.5.1.2
  %.192.1.2 = lshr i64 %.184.2, 1
  %.230.2 = mul nsw i64 %.192.1.2, %arg.width
  %gep.2 = getelementptr double, ptr %.160.2, i64 %.230.2
  %.237.2 = load double, ptr %gep.2, align 8
  %.239.2 = fcmp olt double %.237.2, %.164.2
  %.250.2 = add nuw nsw i64 %.192.1.2, 1
  %high.3.3.2 = select i1 %.239.2, i64 %high.2.1.2, i64 %.192.1.2
  %low.4.3.2 = select i1 %.239.2, i64 %.250.2, i64 %low.5.1.2
  %.281.2 = icmp slt i64 %low.4.3.2, %high.3.3.2
  br i1 %.281.2, label %B102.else.if.2, label %B204.2

B204.2:
  %low.3.2.2 = phi i64 [ %low.3.2.1, %B204.1 ], [ %low.4.3.2, %B102.else.if.2 ]
  %.304.2 = getelementptr i64, ptr %arg.first, i64 %.120.1
  store i64 %low.3.2.2, ptr %.304.2, align 8
  %.120.3 = add nuw nsw i64 %.1138789, 4
  %.158.3 = load i64, ptr %sunkaddr, align 8
  %.160.3 = getelementptr double, ptr %arg.rows, i64 %.158.3
  %.161.3 = load double, ptr %.160.3, align 8
  %.163.3 = uitofp nneg i64 %.120.2 to double
  %.164.3 = fadd double %.161.3, %.163.3
  %.173.3 = icmp slt i64 %low.3.2.2, %arg.count
  br i1 %.173.3, label %B102.else.if.3, label %B204.3

B102.else.if.3:
  %low.5.1.3 = phi i64 [ %low.4.3.3, %B102.else.if.3 ], [ %low.3.2.2, %B204.2 ]
  %high.2.1.3 = phi i64 [ %high.3.3.3, %B102.else.if.3 ], [ %arg.count, %B204.2 ]
  %.184.3 = add nuw nsw i64 %high.2.1.3, %low.5.1.3
  %.192.1.3 = lshr i64 %.184.3, 1
  %.230.3 = mul nsw i64 %.192.1.3, %arg.width
  %gep.3 = getelementptr double, ptr %.160.3, i64 %.230.3
  %.237.3 = load double, ptr %gep.3, align 8
  %.239.3 = fcmp olt double %.237.3, %.164.3
  %.250.3 = add nuw nsw i64 %.192.1.3, 1
  %high.3.3.3 = select i1 %.239.3, i64 %high.2.1.3, i64 %.192.1.3
  %low.4.3.3 = select i1 %.239.3, i64 %.250.3, i64 %low.5.1.3
  %.281.3 = icmp slt i64 %low.4.3.3, %high.3.3.3
  br i1 %.281.3, label %B102.else.if.3, label %B204.3

B204.3:
  %low.3.2.3 = phi i64 [ %low.3.2.2, %B204.2 ], [ %low.4.3.3, %B102.else.if.3 ]
  %.304.3 = getelementptr i64, ptr %arg.first, i64 %.120.2
  store i64 %low.3.2.3, ptr %.304.3, align 8
  %niter.ncmp.3 = icmp eq i64 %.120.3, %unroll_iter
  br i1 %niter.ncmp.3, label %B216.loopexit.unr-lcssa, label %B40

B216.loopexit.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B216, label %B40.epil.preheader

B40.epil.preheader:
  %low.2.091.epil.init = phi i64 [ 0, %B40.lr.ph ], [ %low.3.2.3, %B216.loopexit.unr-lcssa ]
  %.1138789.epil.init = phi i64 [ 0, %B40.lr.ph ], [ %unroll_iter, %B216.loopexit.unr-lcssa ]
  %sunkaddr5 = getelementptr i8, ptr %arg.at, i64 8
  br label %B40.epil

B40.epil:
  %low.2.091.epil = phi i64 [ %low.2.091.epil.init, %B40.epil.preheader ], [ %low.3.2.epil, %B204.epil ]
  %.1138789.epil = phi i64 [ %.1138789.epil.init, %B40.epil.preheader ], [ %.120.epil, %B204.epil ]
  %epil.iter = phi i64 [ 0, %B40.epil.preheader ], [ %epil.iter.next, %B204.epil ]
  %.120.epil = add nuw nsw i64 %.1138789.epil, 1
  %.158.epil = load i64, ptr %sunkaddr5, align 8
  %.160.epil = getelementptr double, ptr %arg.rows, i64 %.158.epil
  %.161.epil = load double, ptr %.160.epil, align 8
  %.163.epil = uitofp nneg i64 %.1138789.epil to double
  %.164.epil = fadd double %.161.epil, %.163.epil
  %.173.epil = icmp slt i64 %low.2.091.epil, %arg.count
  br i1 %.173.epil, label %B102.else.if.epil, label %B204.epil

B102.else.if.epil:
  %low.5.1.epil = phi i64 [ %low.4.3.epil, %B102.else.if.epil ], [ %low.2.091.epil, %B40.epil ]
  %high.2.1.epil = phi i64 [ %high.3.3.epil, %B102.else.if.epil ], [ %arg.count, %B40.epil ]
  %.184.epil = add nuw nsw i64 %high.2.1.epil, %low.5.1.epil
  %.192.1.epil = lshr i64 %.184.epil, 1
  %.230.epil = mul nsw i64 %.192.1.epil, %arg.width
  %gep.epil = getelementptr double, ptr %.160.epil, i64 %.230.epil
  %.237.epil = load double, ptr %gep.epil, align 8
  %.239.epil = fcmp olt double %.237.epil, %.164.epil
  %.250.epil = add nuw nsw i64 %.192.1.epil, 1
  %high.3.3.epil = select i1 %.239.epil, i64 %high.2.1.epil, i64 %.192.1.epil
  %low.4.3.epil = select i1 %.239.epil, i64 %.250.epil, i64 %low.5.1.epil
  %.281.epil = icmp slt i64 %low.4.3.epil, %high.3.3.epil
  br i1 %.281.epil, label %B102.else.if.epil, label %B204.epil

B204.epil:
  %low.3.2.epil = phi i64 [ %low.2.091.epil, %B40.epil ], [ %low.4.3.epil, %B102.else.if.epil ]
  %.304.epil = getelementptr i64, ptr %arg.first, i64 %.1138789.epil
  store i64 %low.3.2.epil, ptr %.304.epil, align 8
  %epil.iter.next = add i64 %epil.iter, 1
  %epil.iter.cmp.not = icmp eq i64 %epil.iter.next, %xtraiter
  br i1 %epil.iter.cmp.not, label %B216, label %B40.epil, !llvm.loop !0

B216:
  %.326 = getelementptr i64, ptr %arg.first, i64 %arg.supports
  store i64 %arg.count, ptr %.326, align 8
  store ptr null, ptr %retptr, align 8
  ret i32 0

B102.else.if:
  %low.5.1 = phi i64 [ %low.4.3, %B102.else.if ], [ %low.2.091, %B40 ]
  %high.2.1 = phi i64 [ %high.3.3, %B102.else.if ], [ %arg.count, %B40 ]
  %.184 = add nuw nsw i64 %high.2.1, %low.5.1
  %.192.1 = lshr i64 %.184, 1
  %.230 = mul nsw i64 %.192.1, %arg.width
  %gep = getelementptr double, ptr %.160, i64 %.230
  %.237 = load double, ptr %gep, align 8
  %.239 = fcmp olt double %.237, %.164
  %.250 = add nuw nsw i64 %.192.1, 1
  %high.3.3 = select i1 %.239, i64 %high.2.1, i64 %.192.1
  %low.4.3 = select i1 %.239, i64 %.250, i64 %low.5.1
  %.281 = icmp slt i64 %low.4.3, %high.3.3
  br i1 %.281, label %B102.else.if, label %B204
}


define ptr @edges(ptr readonly %.1, i64 %.2, ptr readonly %.3, i64 %.4, i64 %.5, ptr writeonly %.6) local_unnamed_addr #1 {
entry:
  %.8 = alloca ptr, align 8
  store ptr null, ptr %.8, align 8
  %.12 = call i32 @_ZN18biped_adrc_kernels5edgesB4v121B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE10float64_2ax8int64_2axx8int64_2a(ptr nonnull %.8, ptr nonnull poison, ptr %.1, i64 %.2, ptr %.3, i64 %.4, i64 %.5, ptr %.6) #2
  %.22 = load ptr, ptr %.8, align 8
  ret ptr %.22
}


define i32 @_ZN18biped_adrc_kernels7demandsB4v122B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE10float64_2ax8int64_2ax8int64_2axx10float64_2a10float64_2a10float64_2a(ptr noalias writeonly %retptr, ptr noalias writeonly %excinfo, ptr readonly %arg.rows, i64 %arg.width, ptr readonly %arg.at, i64 %arg.p, ptr readonly %arg.first, i64 %arg.supports, i64 %arg.impacts, ptr readonly %arg.known, ptr %arg.out, ptr %arg.worst) local_unnamed_addr #2 {
B0.endif:
  %.715 = alloca ptr, align 8
  store ptr null, ptr %.715, align 8
  %excinfo.2 = alloca ptr, align 8
  store ptr null, ptr %excinfo.2, align 8
  %.1436 = alloca ptr, align 8
  store ptr null, ptr %.1436, align 8
  %excinfo.10 = alloca ptr, align 8
  store ptr null, ptr %excinfo.10, align 8
  %.31 = getelementptr i64, ptr %arg.first, i64 %arg.supports
  %.32 = load i64, ptr %.31, align 8
  %.34 = getelementptr i8, ptr %arg.at, i64 64
  %.35 = load i64, ptr %.34, align 8
  %.37 = getelementptr i8, ptr %arg.at, i64 56
  %.38 = load i64, ptr %.37, align 8
  %.62 = getelementptr double, ptr %arg.out, i64 %.32
  %.66.idx = shl i64 %.32, 4
  %.66 = getelementptr i8, ptr %arg.out, i64 %.66.idx
  %.80.idx = mul i64 %.32, 72
  %.80 = getelementptr i8, ptr %arg.out, i64 %.80.idx
  %.84.idx = mul i64 %.32, 80
  %.84 = getelementptr i8, ptr %arg.out, i64 %.84.idx
  %.88.idx = mul i64 %.32, 88
  %.88 = getelementptr i8, ptr %arg.out, i64 %.88.idx
  %.117 = load double, ptr %arg.known, align 8
  %.118 = getelementptr i8, ptr %arg.known, i64 8
  %.119 = load double, ptr %.118, align 8
  %.120 = getelementptr i8, ptr %arg.known, i64 16
  %.121 = load double, ptr %.120, align 8
  %.131 = getelementptr i8, ptr %arg.known, i64 24
  %.132 = load double, ptr %.131, align 8
  %.133 = getelementptr i8, ptr %arg.known, i64 64
  %.134 = load double, ptr %.133, align 8
  %.157 = getelementptr i8, ptr %arg.known, i64 72
  %.idx = mul i64 %arg.p, 48
  %0 = getelementptr i8, ptr %arg.known, i64 %.idx
  %.161 = getelementptr i8, ptr %0, i64 72
  %invariant.gep = getelementptr double, ptr %arg.rows, i64 %.35
  %.250282.not = icmp slt i64 %arg.supports, 1
  br i1 %.250282.not, label %common.ret, label %B630.lr.ph

B630.lr.ph:
  %.396 = fsub double 1.000000e+00, %.132
  %.idx217 = mul i64 %.32, 24
  %1 = getelementptr i8, ptr %arg.out, i64 %.idx217
  %.1093 = fneg double %.121
  %2 = shl i64 %arg.width, 3
  %sunkaddr109 = getelementptr i8, ptr %arg.known, i64 48
  %sunkaddr110 = getelementptr i8, ptr %arg.known, i64 56
  %sunkaddr119 = getelementptr i8, ptr %arg.known, i64 32
  %sunkaddr120 = getelementptr i8, ptr %arg.known, i64 40
  br label %B630.endif

B628.loopexit:
  %before.2.1.lcssa = phi ptr [ %before.3.0285, %B630.endif ], [ %.577, %B984.backedge ]
  %pushed_x.2.1.lcssa = phi double [ %pushed_x.3.0286, %B630.endif ], [ %.612, %B984.backedge ]
  %pushed_z.2.1.lcssa = phi double [ %pushed_z.3.0287, %B630.endif ], [ %.631, %B984.backedge ]
  %exitcond.not = icmp eq i64 %.263, %arg.supports
  br i1 %exitcond.not, label %common.ret, label %B630.endif

B986:
  %i.2.1273 = phi i64 [ %.294, %B986.lr.ph ], [ %i.3.2, %B984.backedge ]
  %pushed_z.2.1272 = phi double [ %pushed_z.3.0287, %B986.lr.ph ], [ %.631, %B984.backedge ]
  %pushed_x.2.1271 = phi double [ %pushed_x.3.0286, %B986.lr.ph ], [ %.612, %B984.backedge ]
  %before.2.1270 = phi ptr [ %before.3.0285, %B986.lr.ph ], [ %.577, %B984.backedge ]
  %.527265269 = phi i64 [ %.484, %B986.lr.ph ], [ %.537, %B984.backedge ]
  %.534266268 = phi i64 [ %.294, %B986.lr.ph ], [ %.541, %B984.backedge ]
  %.537 = add nsw i64 %.527265269, -1
  %.541 = add i64 %.534266268, 1
  %.575 = mul nsw i64 %.534266268, %arg.width
  %.577 = getelementptr double, ptr %arg.rows, i64 %.575
  %.583 = load double, ptr %.577, align 8
  %.588 = fsub double %.583, %.309
  %.594 = load double, ptr %before.2.1270, align 8
  %.595 = fsub double %.583, %.594
  %.596 = fmul double %.595, 5.000000e-01
  %.604 = getelementptr i8, ptr %.577, i64 16
  %.605 = load double, ptr %.604, align 8
  %.607 = getelementptr i8, ptr %before.2.1270, i64 16
  %.608 = load double, ptr %.607, align 8
  %.609 = fadd double %.605, %.608
  %.610 = fmul double %.596, %.609
  %.612 = fadd double %pushed_x.2.1271, %.610
  %.620 = getelementptr i8, ptr %.577, i64 24
  %.621 = load double, ptr %.620, align 8
  %.624 = getelementptr i8, ptr %before.2.1270, i64 24
  %.625 = load double, ptr %.624, align 8
  %.628 = fadd double %.621, %.625
  %.629 = fmul double %.596, %.628
  %.631 = fadd double %pushed_z.2.1272, %.629
  %.643 = getelementptr double, ptr %.577, i64 %.38
  %.644 = load double, ptr %.643, align 8
  %.646 = fsub double %.644, %.612
  %.650 = getelementptr i8, ptr %.643, i64 8
  %.651 = load double, ptr %.650, align 8
  %.653 = fsub double %.651, %.631
  %.656 = getelementptr double, ptr %.84, i64 %.534266268
  store double %.646, ptr %.656, align 8
  %.660 = getelementptr double, ptr %.88, i64 %.534266268
  store double %.653, ptr %.660, align 8
  %.689 = getelementptr double, ptr %arg.out, i64 %.534266268
  store double 0x7FF0000000000000, ptr %.689, align 8
  %.693 = getelementptr double, ptr %.62, i64 %.534266268
  store double 0xFFF0000000000000, ptr %.693, align 8
  %.697 = getelementptr double, ptr %.66, i64 %.534266268
  store double 0.000000e+00, ptr %.697, align 8
  %.701 = getelementptr double, ptr %.80, i64 %.534266268
  store double 0.000000e+00, ptr %.701, align 8
  %.709 = getelementptr double, ptr %1, i64 %.534266268
  store ptr null, ptr %.715, align 8
  %.719 = call i32 @_ZN18biped_adrc_kernels5loadsB4v123B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a8int64_2ax10float64_2a10float64_2ax(ptr nonnull %.715, ptr nonnull %excinfo.2, ptr nonnull %.577, ptr %arg.at, i64 %arg.p, ptr %.157, ptr %.709, i64 %.32)
  %cond = icmp eq i32 %.719, 0
  br i1 %cond, label %B986.endif, label %common.ret, !prof !2

B1568:
  %.758 = add nsw i64 %i.2.1273, 1
  %.760 = icmp slt i64 %.758, %.300
  br i1 %.760, label %B1586, label %B1698

B1586:
  %.774 = mul nsw i64 %.758, %arg.width
  %.776 = getelementptr double, ptr %arg.rows, i64 %.774
  %.777 = load double, ptr %.776, align 8
  %.780 = fsub double %.583, %.13.i
  %.781 = fcmp ugt double %.777, %.780
  br i1 %.781, label %B1698, label %B1628.preheader

B1628.preheader:
  %3 = add i64 %i.2.1273, 2
  %4 = mul i64 %3, %2
  %scevgep = getelementptr i8, ptr %arg.rows, i64 %4
  br label %B1628

B1628:
  %lsr.iv = phi ptr [ %scevgep, %B1628.preheader ], [ %scevgep104, %B1656 ]
  %i.5.4 = phi i64 [ %i.2.1273, %B1628.preheader ], [ %.787, %B1656 ]
  %5 = add i64 %i.5.4, 2
  %.799 = icmp slt i64 %5, %.300
  br i1 %.799, label %B1656, label %B1698.loopexit

B1656:
  %.787 = add i64 %i.5.4, 1
  %.815 = load double, ptr %lsr.iv, align 8
  %.819 = fcmp ugt double %.815, %.780
  %scevgep104 = getelementptr i8, ptr %lsr.iv, i64 %2
  br i1 %.819, label %B1698.loopexit, label %B1628

B1698.loopexit:
  %.787.lcssa = phi i64 [ %6, %B1628 ], [ %.787, %B1656 ]
  %.pre = add nsw i64 %.787.lcssa, 1
  br label %B1698

B1698:
  %.833.pre-phi = phi i64 [ %.pre, %B1698.loopexit ], [ %.758, %B1586 ], [ %.758, %B1568 ]
  %i.4.3 = phi i64 [ %.787.lcssa, %B1698.loopexit ], [ %i.2.1273, %B1586 ], [ %i.2.1273, %B1568 ]
  %.835 = mul nsw i64 %.833.pre-phi, %arg.width
  %.837 = getelementptr double, ptr %arg.rows, i64 %.835
  %.838 = load double, ptr %.837, align 8
  %.841 = mul nsw i64 %i.4.3, %arg.width
  %.843 = getelementptr double, ptr %arg.rows, i64 %.841
  %.844 = load double, ptr %.843, align 8
  %.845 = fsub double %.838, %.844
  %.865 = fcmp ogt double %.845, 0.000000e+00
  br i1 %.865, label %B1796.endif.endif, label %B1864

B1864:
  %"$phi1864.2.2.3" = phi double [ 0.000000e+00, %B1698 ], [ %.13.i56, %B1796.endif.endif ]
  %sunkaddr = shl i64 %.534266268, 3
  %sunkaddr106 = getelementptr i8, ptr %.84, i64 %sunkaddr
  %.953 = load double, ptr %sunkaddr106, align 8
  %.956 = getelementptr double, ptr %.84, i64 %i.4.3
  %.957 = load double, ptr %.956, align 8
  %.958 = fsub double %.953, %.957
  %.962 = getelementptr double, ptr %.84, i64 %.833.pre-phi
  %.963 = load double, ptr %.962, align 8
  %.968 = fsub double %.963, %.957
  %.969 = fmul double %"$phi1864.2.2.3", %.968
  %.970 = fsub double %.958, %.969
  %.975 = fdiv double %.970, %.13.i
  %sunkaddr108 = getelementptr i8, ptr %.88, i64 %sunkaddr
  %.982 = load double, ptr %sunkaddr108, align 8
  %.985 = getelementptr double, ptr %.88, i64 %i.4.3
  %.986 = load double, ptr %.985, align 8
  %.987 = fsub double %.982, %.986
  %.991 = getelementptr double, ptr %.88, i64 %.833.pre-phi
  %.992 = load double, ptr %.991, align 8
  %.997 = fsub double %.992, %.986
  %.998 = fmul double %"$phi1864.2.2.3", %.997
  %.999 = fsub double %.987, %.998
  %.1004 = fdiv double %.999, %.13.i
  %.1006 = fadd double %.119, %.1004
  %.1012 = load double, ptr %sunkaddr109, align 8
  %.1014 = fmul double %.975, %.1012
  %.1017 = load double, ptr %sunkaddr110, align 8
  %.1019 = fmul double %.1017, %.1006
  %.1020 = fadd double %.1014, %.1019
  store double %.1020, ptr %.689, align 8
  %.1029 = fcmp ugt double %.1020, 0.000000e+00
  br i1 %.1029, label %B2124.endif, label %B2220

B2220:
  %i.3.2 = phi i64 [ %i.4.3, %B1864 ], [ %i.4.3, %B2124.endif ], [ %i.2.1273, %B986.endif ]
  %.1077 = getelementptr double, ptr %.577, i64 %.35
  %.1078 = load double, ptr %.1077, align 8
  %.1082 = getelementptr i8, ptr %.1077, i64 8
  %.1083 = load double, ptr %.1082, align 8
  %.1095 = fmul double %.1078, %.1093
  %.1099 = load double, ptr %sunkaddr112, align 8
  %.1100 = fsub double %.1095, %.1099
  %.1109 = fcmp olt double %.1078, 0.000000e+00
  br i1 %.1109, label %B2304, label %B2444

B2304:
  %.1113 = load double, ptr %sunkaddr114, align 8
  %.1114 = fcmp olt double %.1113, 0.000000e+00
  br i1 %.1114, label %B2328.endif.endif, label %B2444

B2444:
  br i1 %.393, label %B2456, label %B2588

B2456:
  %.1202 = load double, ptr %sunkaddr116, align 8
  %.1203 = fcmp ogt double %.1202, 0.000000e+00
  br i1 %.1203, label %B2480.endif.endif.endif, label %B2588

B2588:
  %line.3.2 = phi double [ %.1159, %B2328.endif.endif ], [ %.1272, %B2480.endif.endif.endif ], [ %.1100, %B2456 ], [ %.1100, %B2444 ]
  %riser.3.2 = phi double [ %.1175, %B2328.endif.endif ], [ %.1095, %B2480.endif.endif.endif ], [ %.1100, %B2456 ], [ %.1100, %B2444 ]
  %.1292 = fcmp olt double %.384, %.588
  %.1302 = fcmp olt double %.588, %"$phi930.1.2.1"
  %or.cond215 = select i1 %.1292, i1 %.1302, i1 false
  br i1 %or.cond215, label %B2620.endif.endif, label %B2710

B2710:
  %.1430 = load i64, ptr %sunkaddr118, align 8
  %.1432 = icmp eq i64 %.534266268, %.1430
  %.1440 = zext i1 %.1432 to i8
  %.1441 = call i32 @_ZN18biped_adrc_kernels10keep_worstB4v124B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax10float64_2ab(ptr nonnull %.1436, ptr nonnull %excinfo.10, ptr nonnull %.689, i64 %.32, ptr %.1426, i8 %.1440)
  switch i32 %.1441, label %common.ret [
    i32 -2, label %B984.backedge
    i32 0, label %B984.backedge
  ], !prof !3

B984.backedge:
  %.528 = icmp sgt i64 %.527265269, 1
  br i1 %.528, label %B986, label %B628.loopexit

common.ret:
  %excinfo.sink = phi ptr [ %excinfo, %B2710 ], [ %retptr, %B0.endif ], [ %excinfo, %B986 ], [ %retptr, %B628.loopexit ]
  %common.ret.op = phi i32 [ %.1441, %B2710 ], [ 0, %B0.endif ], [ %.719, %B986 ], [ 0, %B628.loopexit ]
  store ptr null, ptr %excinfo.sink, align 8
  ret i32 %common.ret.op

B630.endif:
  %pushed_z.3.0287 = phi double [ 0.000000e+00, %B630.lr.ph ], [ %pushed_z.2.1.lcssa, %B628.loopexit ]
  %pushed_x.3.0286 = phi double [ 0.000000e+00, %B630.lr.ph ], [ %pushed_x.2.1.lcssa, %B628.loopexit ]
  %before.3.0285 = phi ptr [ %arg.rows, %B630.lr.ph ], [ %before.2.1.lcssa, %B628.loopexit ]
  %.256279283 = phi i64 [ 0, %B630.lr.ph ], [ %.263, %B628.loopexit ]
  %.263 = add nuw nsw i64 %.256279283, 1
  %.293 = getelementptr i64, ptr %arg.first, i64 %.256279283
  %.294 = load i64, ptr %.293, align 8
  %.298 = getelementptr i8, ptr %.293, i64 8
  %.299 = load i64, ptr %.298, align 8
  %.300 = add nsw i64 %.299, -1
  %.306 = mul nsw i64 %.294, %arg.width
  %.308 = getelementptr double, ptr %arg.rows, i64 %.306
  %.309 = load double, ptr %.308, align 8
  %.328 = mul nsw i64 %.300, %arg.width
  %.343 = getelementptr double, ptr %arg.rows, i64 %.328
  %.344 = load double, ptr %.343, align 8
  %.346 = fsub double %.344, %.309
  %.12.i = fcmp olt double %.346, %.117
  %.13.i = select i1 %.12.i, double %.346, double %.117
  %.382 = fmul double %.132, %.346
  %.384 = fadd double %.134, %.382
  %.393 = icmp slt i64 %.256279283, %arg.impacts
  %.398 = fmul double %.396, %.346
  %.402 = fsub double %.398, %.134
  %"$phi930.1.2.1" = select i1 %.393, double %.402, double 0x7FF0000000000000
  %.484 = sub i64 %.299, %.294
  %.528267.not = icmp slt i64 %.484, 1
  br i1 %.528267.not, label %B628.loopexit, label %B986.lr.ph

B986.lr.ph:
  %.747 = fsub double %.13.i, %.134
  %.1426.idx = mul i64 %.256279283, 80
  %.1426 = getelementptr i8, ptr %arg.worst, i64 %.1426.idx
  %6 = add i64 %.299, -2
  %7 = fcmp ogt double %.13.i, 1.000000e-09
  %sunkaddr111 = shl i64 %.256279283, 3
  %sunkaddr112 = getelementptr inbounds i8, ptr %.161, i64 %sunkaddr111
  %sunkaddr113 = shl i64 %.306, 3
  %sunkaddr114 = getelementptr i8, ptr %invariant.gep, i64 %sunkaddr113
  %sunkaddr115 = shl i64 %.328, 3
  %sunkaddr116 = getelementptr i8, ptr %invariant.gep, i64 %sunkaddr115
  %sunkaddr128 = getelementptr i8, ptr %sunkaddr116, i64 8
  %sunkaddr125 = getelementptr i8, ptr %sunkaddr114, i64 8
  %sunkaddr118 = getelementptr i8, ptr %arg.first, i64 %sunkaddr111
  br label %B986

B986.endif:
  %.749 = fcmp oge double %.588, %.747
  %or.cond = select i1 %7, i1 %.749, i1 false
  br i1 %or.cond, label %B1568, label %B2220

B1796.endif.endif:
  %.848 = fsub double %.583, %.13.i
  %.857 = fsub double %.848, %.844
  %.872 = fdiv double %.857, %.845
  %.12.i53 = fcmp olt double %.872, 0.000000e+00
  %.13.i54 = select i1 %.12.i53, double 0.000000e+00, double %.872
  %.12.i55 = fcmp ogt double %.13.i54, 1.000000e+00
  %.13.i56 = select i1 %.12.i55, double 1.000000e+00, double %.13.i54
  br label %B1864

B2124.endif:
  %.1038 = load double, ptr %sunkaddr119, align 8
  %.1040 = fmul double %.975, %.1038
  %.1045 = load double, ptr %sunkaddr120, align 8
  %.1047 = fmul double %.1006, %.1045
  %.1050 = fadd double %.1040, %.1047
  %.1051 = tail call double @llvm.fabs.f64(double %.1050)
  %.1059 = fdiv double %.1051, %.1020
  %sunkaddr122 = getelementptr inbounds i8, ptr %.62, i64 %sunkaddr
  store double %.1059, ptr %sunkaddr122, align 8
  br label %B2220

B2328.endif.endif:
  %.1122 = load double, ptr %sunkaddr125, align 8
  %.1130 = fdiv double %.1078, %.1113
  %.12.i57 = fcmp ogt double %.1130, 1.000000e+00
  %.13.i58 = select i1 %.12.i57, double 1.000000e+00, double %.1130
  %.1159 = fmul double %.13.i58, %.1122
  %.1170 = fsub double %.1078, %.1113
  %.1174 = fmul double %.121, %.1170
  %.1175 = fsub double %.1122, %.1174
  br label %B2588

B2480.endif.endif.endif:
  %.1207 = load double, ptr %sunkaddr128, align 8
  %.1215 = fdiv double %.1078, %.1202
  %.12.i59 = fcmp olt double %.1215, 0.000000e+00
  %.13.i60 = select i1 %.12.i59, double 0.000000e+00, double %.1215
  %.12.i61 = fcmp ogt double %.13.i60, 1.000000e+00
  %.13.i62 = select i1 %.12.i61, double 1.000000e+00, double %.13.i60
  %.1272 = fmul double %.13.i62, %.1207
  br label %B2588

B2620.endif.endif:
  %.1318 = fsub double %line.3.2, %.1083
  %.12.i51 = fcmp ogt double %.1318, 0.000000e+00
  %.13.i52 = select i1 %.12.i51, double %.1318, double 0.000000e+00
  %.1351 = fsub double %riser.3.2, %.1083
  %.12.i63 = fcmp ogt double %.1351, 0.000000e+00
  %.13.i64 = select i1 %.12.i63, double %.1351, double 0.000000e+00
  %sunkaddr129 = shl i64 %.534266268, 3
  %sunkaddr130 = getelementptr inbounds i8, ptr %.66, i64 %sunkaddr129
  store double %.13.i52, ptr %sunkaddr130, align 8
  %sunkaddr132 = getelementptr inbounds i8, ptr %.80, i64 %sunkaddr129
  store double %.13.i64, ptr %sunkaddr132, align 8
  br label %B2710
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels5loadsB4v123B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2a8int64_2ax10float64_2a10float64_2ax(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.row, ptr readonly %arg.at, i64 %arg.p, ptr readonly %arg.joints, ptr initializes((0, 8)) %arg.out, i64 %arg.count) local_unnamed_addr #2 {
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
  br i1 %exitcond.not, label %common.ret, label %B516.us, !llvm.loop !4
}


define linkonce_odr i32 @_ZN18biped_adrc_kernels10keep_worstB4v124B58c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAQ4s_2fqErM2IZJFEEM0wQAE10float64_2ax10float64_2ab(ptr noalias writeonly initializes((0, 8)) %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.numbers, i64 %arg.count, ptr %arg.worst, i8 %arg.begins) local_unnamed_addr #2 {
entry:
  %.10.not = icmp eq i8 %arg.begins, 0
  %.17282.idx = mul i64 %arg.count, 72
  %.173.us = load double, ptr %arg.numbers, align 8
  br i1 %.10.not, label %B130.us, label %B249.6

B130.us:
  %.177.us = load double, ptr %arg.worst, align 8
  %.189.us = fcmp olt double %.173.us, %.177.us
  %.214.us = fcmp uno double %.173.us, 0.000000e+00
  %or.cond.us = or i1 %.214.us, %.189.us
  %.218.us = fcmp ord double %.177.us, 0.000000e+00
  %or.cond91.us = and i1 %.218.us, %or.cond.us
  br i1 %or.cond91.us, label %B164.us, label %B130.us.1

B164.us:
  store double %.173.us, ptr %arg.worst, align 8
  br label %B130.us.1

B130.us.1:
  %.172.us.1 = getelementptr double, ptr %arg.numbers, i64 %arg.count
  %.173.us.1 = load double, ptr %.172.us.1, align 8
  %.176.us.1 = getelementptr i8, ptr %arg.worst, i64 8
  %.177.us.1 = load double, ptr %.176.us.1, align 8
  %.196.us.1 = fcmp ogt double %.173.us.1, %.177.us.1
  %.214.us.1 = fcmp uno double %.173.us.1, 0.000000e+00
  %or.cond.us.1 = or i1 %.214.us.1, %.196.us.1
  %.218.us.1 = fcmp ord double %.177.us.1, 0.000000e+00
  %or.cond91.us.1 = and i1 %.218.us.1, %or.cond.us.1
  br i1 %or.cond91.us.1, label %B164.us.1, label %B130.us.2

B164.us.1:
  store double %.173.us.1, ptr %.176.us.1, align 8
  br label %B130.us.2

B130.us.2:
  %.172.us.2.idx = shl i64 %arg.count, 4
  %.172.us.2 = getelementptr i8, ptr %arg.numbers, i64 %.172.us.2.idx
  %.173.us.2 = load double, ptr %.172.us.2, align 8
  %.176.us.2 = getelementptr i8, ptr %arg.worst, i64 16
  %.177.us.2 = load double, ptr %.176.us.2, align 8
  %.196.us.2 = fcmp ogt double %.173.us.2, %.177.us.2
  %.214.us.2 = fcmp uno double %.173.us.2, 0.000000e+00
  %or.cond.us.2 = or i1 %.214.us.2, %.196.us.2
  %.218.us.2 = fcmp ord double %.177.us.2, 0.000000e+00
  %or.cond91.us.2 = and i1 %.218.us.2, %or.cond.us.2
  br i1 %or.cond91.us.2, label %B164.us.2, label %B130.us.3

B164.us.2:
  store double %.173.us.2, ptr %.176.us.2, align 8
  br label %B130.us.3

B130.us.3:
  %.172.us.3.idx = mul i64 %arg.count, 24
  %.172.us.3 = getelementptr i8, ptr %arg.numbers, i64 %.172.us.3.idx
  %.173.us.3 = load double, ptr %.172.us.3, align 8
  %.176.us.3 = getelementptr i8, ptr %arg.worst, i64 24
  %.177.us.3 = load double, ptr %.176.us.3, align 8
  %.196.us.3 = fcmp ogt double %.173.us.3, %.177.us.3
  %.214.us.3 = fcmp uno double %.173.us.3, 0.000000e+00
  %or.cond.us.3 = or i1 %.214.us.3, %.196.us.3
  %.218.us.3 = fcmp ord double %.177.us.3, 0.000000e+00
  %or.cond91.us.3 = and i1 %.218.us.3, %or.cond.us.3
  br i1 %or.cond91.us.3, label %B206.us.3, label %B130.us.4

B206.us.3:
  store double %.173.us.3, ptr %.176.us.3, align 8
  %.256.us.3.idx = mul i64 %arg.count, 48
  %.256.us.3 = getelementptr i8, ptr %arg.numbers, i64 %.256.us.3.idx
  %.257.us.3 = load double, ptr %.256.us.3, align 8
  %.263.us.3 = getelementptr i8, ptr %arg.worst, i64 48
  store double %.257.us.3, ptr %.263.us.3, align 8
  br label %B130.us.4

B130.us.4:
  %.172.us.4.idx = shl i64 %arg.count, 5
  %.172.us.4 = getelementptr i8, ptr %arg.numbers, i64 %.172.us.4.idx
  %.173.us.4 = load double, ptr %.172.us.4, align 8
  %.176.us.4 = getelementptr i8, ptr %arg.worst, i64 32
  %.177.us.4 = load double, ptr %.176.us.4, align 8
  %.196.us.4 = fcmp ogt double %.173.us.4, %.177.us.4
  %.214.us.4 = fcmp uno double %.173.us.4, 0.000000e+00
  %or.cond.us.4 = or i1 %.214.us.4, %.196.us.4
  %.218.us.4 = fcmp ord double %.177.us.4, 0.000000e+00
  %or.cond91.us.4 = and i1 %.218.us.4, %or.cond.us.4
  br i1 %or.cond91.us.4, label %B206.us.4, label %B130.us.5

B206.us.4:
  store double %.173.us.4, ptr %.176.us.4, align 8
  %.256.us.4.idx = mul i64 %arg.count, 56
  %.256.us.4 = getelementptr i8, ptr %arg.numbers, i64 %.256.us.4.idx
  %.257.us.4 = load double, ptr %.256.us.4, align 8
  %.263.us.4 = getelementptr i8, ptr %arg.worst, i64 56
  store double %.257.us.4, ptr %.263.us.4, align 8
  br label %B130.us.5

B130.us.5:
  %.172.us.5.idx = mul i64 %arg.count, 40
  %.172.us.5 = getelementptr i8, ptr %arg.numbers, i64 %.172.us.5.idx
  %.173.us.5 = load double, ptr %.172.us.5, align 8
  %.176.us.5 = getelementptr i8, ptr %arg.worst, i64 40
  %.177.us.5 = load double, ptr %.176.us.5, align 8
  %.196.us.5 = fcmp ogt double %.173.us.5, %.177.us.5
  %.214.us.5 = fcmp uno double %.173.us.5, 0.000000e+00
  %or.cond.us.5 = or i1 %.214.us.5, %.196.us.5
  %.218.us.5 = fcmp ord double %.177.us.5, 0.000000e+00
  %or.cond91.us.5 = and i1 %.218.us.5, %or.cond.us.5
  br i1 %or.cond91.us.5, label %B206.us.5, label %B130.us.6

B206.us.5:
  store double %.173.us.5, ptr %.176.us.5, align 8
  %.256.us.5.idx = shl i64 %arg.count, 6
  %.256.us.5 = getelementptr i8, ptr %arg.numbers, i64 %.256.us.5.idx
  %.257.us.5 = load double, ptr %.256.us.5, align 8
  %.263.us.5 = getelementptr i8, ptr %arg.worst, i64 64
  store double %.257.us.5, ptr %.263.us.5, align 8
  br label %B130.us.6

B130.us.6:
  %sunkaddr8 = getelementptr i8, ptr %arg.numbers, i64 %.17282.idx
  %.17383.us.6 = load double, ptr %sunkaddr8, align 8
  %sunkaddr9 = getelementptr i8, ptr %arg.worst, i64 72
  %.17785.us.6 = load double, ptr %sunkaddr9, align 8
  %.196.us.6 = fcmp ogt double %.17383.us.6, %.17785.us.6
  %.214.us.6 = fcmp uno double %.17383.us.6, 0.000000e+00
  %or.cond.us.6 = or i1 %.214.us.6, %.196.us.6
  %.218.us.6 = fcmp ord double %.17785.us.6, 0.000000e+00
  %or.cond91.us.6 = and i1 %.218.us.6, %or.cond.us.6
  br i1 %or.cond91.us.6, label %B248.sink.split, label %B248

B248.sink.split:
  %.17383.us.6.sink = phi double [ %.17374100.6, %B249.6 ], [ %.17383.us.6, %B130.us.6 ]
  %sunkaddr10 = getelementptr i8, ptr %arg.worst, i64 72
  store double %.17383.us.6.sink, ptr %sunkaddr10, align 8
  br label %B248

B248:
  store ptr null, ptr %retptr, align 8
  ret i32 0

B249.6:
  store double %.173.us, ptr %arg.worst, align 8
  %.172.1 = getelementptr double, ptr %arg.numbers, i64 %arg.count
  %.176.1 = getelementptr i8, ptr %arg.worst, i64 8
  %.17374.1 = load double, ptr %.172.1, align 8
  store double %.17374.1, ptr %.176.1, align 8
  %.172.2.idx = shl i64 %arg.count, 4
  %.172.2 = getelementptr i8, ptr %arg.numbers, i64 %.172.2.idx
  %.176.2 = getelementptr i8, ptr %arg.worst, i64 16
  %.17374.2 = load double, ptr %.172.2, align 8
  store double %.17374.2, ptr %.176.2, align 8
  %.172.3.idx = mul i64 %arg.count, 24
  %.172.3 = getelementptr i8, ptr %arg.numbers, i64 %.172.3.idx
  %.176.3 = getelementptr i8, ptr %arg.worst, i64 24
  %.17374.3 = load double, ptr %.172.3, align 8
  store double %.17374.3, ptr %.176.3, align 8
  %.256.3.idx = mul i64 %arg.count, 48
  %.256.3 = getelementptr i8, ptr %arg.numbers, i64 %.256.3.idx
  %.257.3 = load double, ptr %.256.3, align 8
  %.263.3 = getelementptr i8, ptr %arg.worst, i64 48
  store double %.257.3, ptr %.263.3, align 8
  %.172.4.idx = shl i64 %arg.count, 5
  %.172.4 = getelementptr i8, ptr %arg.numbers, i64 %.172.4.idx
  %.176.4 = getelementptr i8, ptr %arg.worst, i64 32
  %.17374.4 = load double, ptr %.172.4, align 8
  store double %.17374.4, ptr %.176.4, align 8
  %.256.4.idx = mul i64 %arg.count, 56
  %.256.4 = getelementptr i8, ptr %arg.numbers, i64 %.256.4.idx
  %.257.4 = load double, ptr %.256.4, align 8
  %.263.4 = getelementptr i8, ptr %arg.worst, i64 56
  store double %.257.4, ptr %.263.4, align 8
  %.172.5.idx = mul i64 %arg.count, 40
  %.172.5 = getelementptr i8, ptr %arg.numbers, i64 %.172.5.idx
  %.176.5 = getelementptr i8, ptr %arg.worst, i64 40
  %.17374.5 = load double, ptr %.172.5, align 8
  store double %.17374.5, ptr %.176.5, align 8
  %.256.5.idx = shl i64 %arg.count, 6
  %.256.5 = getelementptr i8, ptr %arg.numbers, i64 %.256.5.idx
  %.257.5 = load double, ptr %.256.5, align 8
  %.263.5 = getelementptr i8, ptr %arg.worst, i64 64
  store double %.257.5, ptr %.263.5, align 8
  %sunkaddr11 = getelementptr i8, ptr %arg.numbers, i64 %.17282.idx
  %.17374100.6 = load double, ptr %sunkaddr11, align 8
  br label %B248.sink.split
}


declare double @llvm.fabs.f64(double) #3


define ptr @demands(ptr readonly %.1, i64 %.2, ptr readonly %.3, i64 %.4, ptr readonly %.5, i64 %.6, i64 %.7, ptr readonly %.8, ptr %.9, ptr %.10) local_unnamed_addr #2 {
entry:
  %.12 = alloca ptr, align 8
  store ptr null, ptr %.12, align 8
  %excinfo = alloca ptr, align 8
  %.16 = call i32 @_ZN18biped_adrc_kernels7demandsB4v122B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE10float64_2ax8int64_2ax8int64_2axx10float64_2a10float64_2a10float64_2a(ptr nonnull %.12, ptr nonnull %excinfo, ptr %.1, i64 %.2, ptr %.3, i64 %.4, ptr %.5, i64 %.6, i64 %.7, ptr %.8, ptr %.9, ptr %.10) #2
  %cond = icmp eq i32 %.16, 0
  br i1 %cond, label %common.ret, label %entry.if, !prof !2

entry.if:
  tail call void @llvm.trap()
  unreachable

common.ret:
  %.26 = load ptr, ptr %.12, align 8
  ret ptr %.26
}


define void @numba_gil_ensure(ptr readnone %0) local_unnamed_addr #4 {
  tail call void @llvm.trap()
  unreachable
}


define noalias nonnull ptr @PyUnicode_FromString(ptr readnone %0) local_unnamed_addr #4 {
  tail call void @llvm.trap()
  unreachable
}


define void @PyErr_WriteUnraisable(ptr readnone %0) local_unnamed_addr #4 {
  tail call void @llvm.trap()
  unreachable
}


define void @Py_DecRef(ptr readnone %0) local_unnamed_addr #4 {
  tail call void @llvm.trap()
  unreachable
}


define void @numba_gil_release(ptr readnone %0) local_unnamed_addr #4 {
  tail call void @llvm.trap()
  unreachable
}


define void @PyErr_Clear() local_unnamed_addr #4 {
  tail call void @llvm.trap()
  unreachable
}


define noalias nonnull ptr @PyBytes_FromStringAndSize(ptr readnone %0, i64 %1) local_unnamed_addr #4 {
  tail call void @llvm.trap()
  unreachable
}


define noalias nonnull ptr @numba_unpickle(ptr readnone %0, i32 %1, ptr readnone %2) local_unnamed_addr #4 {
  tail call void @llvm.trap()
  unreachable
}


define void @PyErr_SetString(ptr readnone %0, ptr readnone %1) local_unnamed_addr #4 {
  tail call void @llvm.trap()
  unreachable
}


define noalias nonnull ptr @numba_runtime_build_excinfo_struct(ptr readnone %0, ptr readnone %1) local_unnamed_addr #4 {
  tail call void @llvm.trap()
  unreachable
}


define void @NRT_Free(ptr readnone %0) local_unnamed_addr #4 {
  tail call void @llvm.trap()
  unreachable
}


define void @numba_do_raise(ptr readnone %0) local_unnamed_addr #4 {
  tail call void @llvm.trap()
  unreachable
}


define void @PyErr_SetNone(ptr readnone %0) local_unnamed_addr #4 {
  tail call void @llvm.trap()
  unreachable
}


define i32 @_ZN18biped_adrc_kernels6totalsB4v125B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE10float64_2ax8int64_2axx10float64_2a(ptr noalias writeonly %retptr, ptr noalias readnone %excinfo, ptr readonly %arg.rows, i64 %arg.width, ptr readonly %arg.at, i64 %arg.p, i64 %arg.count, ptr %arg.out) local_unnamed_addr #0 {
B0.endif:
  %.105164.not = icmp slt i64 %arg.count, 1
  br i1 %.105164.not, label %B820, label %B38.endif.lr.ph

B38.endif.lr.ph:
  %arg.p.fr = freeze i64 %arg.p
  %.216 = icmp sgt i64 %arg.p.fr, 0
  br i1 %.216, label %B38.endif.us.us.preheader, label %B38.endif.preheader

B38.endif.preheader:
  %xtraiter = and i64 %arg.count, 7
  %0 = icmp samesign ult i64 %arg.count, 8
  br i1 %0, label %B38.endif.preheader.B38.endif.epil.preheader_crit_edge, label %B38.endif.preheader.new

B38.endif.preheader.B38.endif.epil.preheader_crit_edge:
  %.pre = shl i64 %arg.width, 3
  br label %B38.endif.epil.preheader

B38.endif.preheader.new:
  %1 = mul i64 %arg.width, 56
  %2 = shl i64 %arg.width, 6
  %3 = mul i64 %arg.width, 48
  %4 = mul i64 %arg.width, 40
  %5 = shl i64 %arg.width, 5
  %6 = mul i64 %arg.width, 24
  %7 = shl i64 %arg.width, 4
  %8 = and i64 %arg.count, 9223372036854775800
  %sunkaddr138 = shl i64 %arg.width, 3
  %sunkaddr152 = getelementptr i8, ptr %arg.out, i64 8
  br label %B38.endif

B38.endif.us.us.preheader:
  %arg.out.promoted.us.us.pre = load double, ptr %arg.out, align 8
  %xtraiter8 = and i64 %arg.p.fr, 7
  %unroll_iter13 = and i64 %arg.p.fr, 9223372036854775800
  %xtraiter15 = and i64 %arg.p.fr, 3
  %unroll_iter19 = and i64 %arg.p.fr, 9223372036854775804
  %scevgep = getelementptr i8, ptr %arg.rows, i64 32
  %9 = shl i64 %arg.width, 3
  %scevgep43 = getelementptr i8, ptr %arg.rows, i64 16
  %scevgep54 = getelementptr i8, ptr %arg.rows, i64 24
  %10 = getelementptr i8, ptr %arg.rows, i64 %9
  %scevgep73 = getelementptr i8, ptr %10, i64 16
  %11 = shl nuw nsw i64 %xtraiter15, 3
  %12 = icmp samesign ult i64 %arg.p.fr, 8
  %sunkaddr = getelementptr i8, ptr %arg.at, i64 24
  %sunkaddr123 = getelementptr i8, ptr %arg.at, i64 32
  %sunkaddr124 = getelementptr i8, ptr %arg.at, i64 40
  %13 = icmp eq i64 %xtraiter8, 0
  %14 = icmp samesign ult i64 %arg.p.fr, 4
  %sunkaddr125 = getelementptr i8, ptr %arg.out, i64 8
  %sunkaddr126 = getelementptr i8, ptr %arg.out, i64 16
  %sunkaddr127 = getelementptr i8, ptr %arg.out, i64 24
  %sunkaddr128 = getelementptr i8, ptr %arg.out, i64 32
  %sunkaddr129 = getelementptr i8, ptr %arg.out, i64 40
  %15 = icmp eq i64 %xtraiter15, 0
  br label %B38.endif.us.us

B38.endif.us.us:
  %arg.rows.pn = phi ptr [ %arg.rows, %B38.endif.us.us.preheader ], [ %lsr.iv90, %B816.us.us ]
  %lsr.iv74 = phi ptr [ %scevgep73, %B38.endif.us.us.preheader ], [ %scevgep75, %B816.us.us ]
  %lsr.iv55 = phi ptr [ %scevgep54, %B38.endif.us.us.preheader ], [ %scevgep56, %B816.us.us ]
  %lsr.iv44 = phi ptr [ %scevgep43, %B38.endif.us.us.preheader ], [ %scevgep45, %B816.us.us ]
  %lsr.iv = phi ptr [ %scevgep, %B38.endif.us.us.preheader ], [ %scevgep22, %B816.us.us ]
  %arg.out.promoted.us.us = phi double [ %arg.out.promoted.us.us.pre, %B38.endif.us.us.preheader ], [ %arg.out.promoted.us.us257.lcssa, %B816.us.us ]
  %.111153167.us.us = phi i64 [ 0, %B38.endif.us.us.preheader ], [ %.118.us.us, %B816.us.us ]
  %lsr.iv90 = getelementptr i8, ptr %arg.rows.pn, i64 %9
  %.148.us.us = mul nsw i64 %.111153167.us.us, %arg.width
  %.150.us.us = getelementptr double, ptr %arg.rows, i64 %.148.us.us
  %.156.us.us = load i64, ptr %sunkaddr, align 8
  %.161.us.us = load i64, ptr %sunkaddr123, align 8
  %.166.us.us = load i64, ptr %sunkaddr124, align 8
  br i1 %12, label %B272.us.us.epil.preheader, label %B272.us.us.preheader

B272.us.us.preheader:
  %16 = shl i64 %.156.us.us, 3
  %scevgep23 = getelementptr i8, ptr %lsr.iv, i64 %16
  br label %B272.us.us

B440.us.us:
  %.346.us.us = getelementptr double, ptr %.150.us.us, i64 %arg.width
  %.347.us.us = load double, ptr %.346.us.us, align 8
  %.350.us.us = load double, ptr %.150.us.us, align 8
  %.353.us.us = fcmp ogt double %.347.us.us, %.350.us.us
  br i1 %.353.us.us, label %B476.endif.us.us, label %B816.us.us

B476.endif.us.us:
  %.357.us.us = load double, ptr %sunkaddr125, align 8
  %.358.us.us = fadd double %.357.us.us, 1.000000e+00
  store double %.358.us.us, ptr %sunkaddr125, align 8
  %.494.promoted.us.us = load double, ptr %sunkaddr126, align 8
  %.508.promoted.us.us = load double, ptr %sunkaddr127, align 8
  %.522.promoted.us.us = load double, ptr %sunkaddr128, align 8
  %.530.promoted.us.us = load double, ptr %sunkaddr129, align 8
  br i1 %14, label %B540.us.us.epil.preheader, label %B540.us.us.preheader

B540.us.us.preheader:
  %17 = shl i64 %.166.us.us, 3
  %scevgep46 = getelementptr i8, ptr %lsr.iv44, i64 %17
  %18 = shl i64 %.156.us.us, 3
  %scevgep57 = getelementptr i8, ptr %lsr.iv55, i64 %18
  %19 = shl i64 %.161.us.us, 3
  %scevgep65 = getelementptr i8, ptr %lsr.iv44, i64 %19
  %scevgep76 = getelementptr i8, ptr %lsr.iv74, i64 %17
  br label %B540.us.us

B816.us.us.loopexit.unr-lcssa:
  br i1 %15, label %B816.us.us, label %B540.us.us.epil.preheader

B540.us.us.epil.preheader:
  %.531151.us.us.epil.init = phi double [ %.530.promoted.us.us, %B476.endif.us.us ], [ %.532.us.us.3, %B816.us.us.loopexit.unr-lcssa ]
  %.523150.us.us.epil.init = phi double [ %.522.promoted.us.us, %B476.endif.us.us ], [ %.525.us.us.3, %B816.us.us.loopexit.unr-lcssa ]
  %.509149.us.us.epil.init = phi double [ %.508.promoted.us.us, %B476.endif.us.us ], [ %.517.us.us.3, %B816.us.us.loopexit.unr-lcssa ]
  %.495148.us.us.epil.init = phi double [ %.494.promoted.us.us, %B476.endif.us.us ], [ %.503.us.us.3, %B816.us.us.loopexit.unr-lcssa ]
  %.448142144.us.us.epil.init = phi i64 [ 0, %B476.endif.us.us ], [ %unroll_iter19, %B816.us.us.loopexit.unr-lcssa ]
  %20 = add i64 %.448142144.us.us.epil.init, %.156.us.us
  %21 = shl i64 %20, 3
  %scevgep84 = getelementptr i8, ptr %arg.rows.pn, i64 %21
  %22 = add i64 %.448142144.us.us.epil.init, %.166.us.us
  %23 = shl i64 %22, 3
  %scevgep87 = getelementptr i8, ptr %arg.rows.pn, i64 %23
  %scevgep92 = getelementptr i8, ptr %lsr.iv90, i64 %23
  %24 = add i64 %.448142144.us.us.epil.init, %.161.us.us
  %25 = shl i64 %24, 3
  %scevgep94 = getelementptr i8, ptr %arg.rows.pn, i64 %25
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
  store double %.503.us.us.epil, ptr %sunkaddr126, align 8
  %.512.us.us.epil = load double, ptr %scevgep95, align 8
  %.516.us.us.epil = fmul double %.512.us.us.epil, %.512.us.us.epil
  %.517.us.us.epil = fadd double %.509149.us.us.epil, %.516.us.us.epil
  store double %.517.us.us.epil, ptr %sunkaddr127, align 8
  %.524.us.us.epil = tail call double @llvm.fabs.f64(double %.492.us.us.epil)
  %.525.us.us.epil = fadd double %.523150.us.us.epil, %.524.us.us.epil
  store double %.525.us.us.epil, ptr %sunkaddr128, align 8
  %.532.us.us.epil = fadd double %.531151.us.us.epil, %.492.us.us.epil
  store double %.532.us.us.epil, ptr %sunkaddr129, align 8
  %lsr.iv.next = add nuw nsw i64 %lsr.iv85, 8
  %epil.iter16.cmp.not = icmp eq i64 %11, %lsr.iv.next
  br i1 %epil.iter16.cmp.not, label %B816.us.us, label %B540.us.us.epil, !llvm.loop !6

B816.us.us:
  %scevgep22 = getelementptr i8, ptr %lsr.iv, i64 %9
  %scevgep45 = getelementptr i8, ptr %lsr.iv44, i64 %9
  %scevgep56 = getelementptr i8, ptr %lsr.iv55, i64 %9
  %scevgep75 = getelementptr i8, ptr %lsr.iv74, i64 %9
  %exitcond256.not = icmp eq i64 %arg.count, %.118.us.us
  br i1 %exitcond256.not, label %B820, label %B38.endif.us.us

B540.us.us:
  %.531151.us.us = phi double [ %.532.us.us.3, %B540.us.us ], [ %.530.promoted.us.us, %B540.us.us.preheader ]
  %.523150.us.us = phi double [ %.525.us.us.3, %B540.us.us ], [ %.522.promoted.us.us, %B540.us.us.preheader ]
  %.509149.us.us = phi double [ %.517.us.us.3, %B540.us.us ], [ %.508.promoted.us.us, %B540.us.us.preheader ]
  %.495148.us.us = phi double [ %.503.us.us.3, %B540.us.us ], [ %.494.promoted.us.us, %B540.us.us.preheader ]
  %.448142144.us.us = phi i64 [ %.455.us.us.3, %B540.us.us ], [ 0, %B540.us.us.preheader ]
  %26 = shl i64 %.448142144.us.us, 3
  %scevgep67 = getelementptr i8, ptr %scevgep65, i64 %26
  %scevgep68 = getelementptr i8, ptr %scevgep67, i64 -16
  %.482.us.us = load double, ptr %scevgep68, align 8
  %scevgep78 = getelementptr i8, ptr %scevgep76, i64 %26
  %scevgep79 = getelementptr i8, ptr %scevgep78, i64 -16
  %.487.us.us = load double, ptr %scevgep79, align 8
  %scevgep50 = getelementptr i8, ptr %scevgep46, i64 %26
  %scevgep51 = getelementptr i8, ptr %scevgep50, i64 -16
  %.490.us.us = load double, ptr %scevgep51, align 8
  %.491.us.us = fsub double %.487.us.us, %.490.us.us
  %.492.us.us = fmul double %.482.us.us, %.491.us.us
  %scevgep59 = getelementptr i8, ptr %scevgep57, i64 %26
  %scevgep60 = getelementptr i8, ptr %scevgep59, i64 -24
  %.498.us.us = load double, ptr %scevgep60, align 8
  %.502.us.us = fmul double %.498.us.us, %.498.us.us
  %.503.us.us = fadd double %.495148.us.us, %.502.us.us
  store double %.503.us.us, ptr %sunkaddr126, align 8
  %.512.us.us = load double, ptr %scevgep68, align 8
  %.516.us.us = fmul double %.512.us.us, %.512.us.us
  %.517.us.us = fadd double %.509149.us.us, %.516.us.us
  store double %.517.us.us, ptr %sunkaddr127, align 8
  %.524.us.us = tail call double @llvm.fabs.f64(double %.492.us.us)
  %.525.us.us = fadd double %.523150.us.us, %.524.us.us
  store double %.525.us.us, ptr %sunkaddr128, align 8
  %.532.us.us = fadd double %.531151.us.us, %.492.us.us
  store double %.532.us.us, ptr %sunkaddr129, align 8
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
  store double %.503.us.us.1, ptr %sunkaddr126, align 8
  %.512.us.us.1 = load double, ptr %scevgep72, align 8
  %.516.us.us.1 = fmul double %.512.us.us.1, %.512.us.us.1
  %.517.us.us.1 = fadd double %.517.us.us, %.516.us.us.1
  store double %.517.us.us.1, ptr %sunkaddr127, align 8
  %.524.us.us.1 = tail call double @llvm.fabs.f64(double %.492.us.us.1)
  %.525.us.us.1 = fadd double %.525.us.us, %.524.us.us.1
  store double %.525.us.us.1, ptr %sunkaddr128, align 8
  %.532.us.us.1 = fadd double %.532.us.us, %.492.us.us.1
  store double %.532.us.us.1, ptr %sunkaddr129, align 8
  %.482.us.us.2 = load double, ptr %scevgep67, align 8
  %.487.us.us.2 = load double, ptr %scevgep78, align 8
  %.490.us.us.2 = load double, ptr %scevgep50, align 8
  %.491.us.us.2 = fsub double %.487.us.us.2, %.490.us.us.2
  %.492.us.us.2 = fmul double %.482.us.us.2, %.491.us.us.2
  %scevgep62 = getelementptr i8, ptr %scevgep59, i64 -8
  %.498.us.us.2 = load double, ptr %scevgep62, align 8
  %.502.us.us.2 = fmul double %.498.us.us.2, %.498.us.us.2
  %.503.us.us.2 = fadd double %.503.us.us.1, %.502.us.us.2
  store double %.503.us.us.2, ptr %sunkaddr126, align 8
  %.512.us.us.2 = load double, ptr %scevgep67, align 8
  %.516.us.us.2 = fmul double %.512.us.us.2, %.512.us.us.2
  %.517.us.us.2 = fadd double %.517.us.us.1, %.516.us.us.2
  store double %.517.us.us.2, ptr %sunkaddr127, align 8
  %.524.us.us.2 = tail call double @llvm.fabs.f64(double %.492.us.us.2)
  %.525.us.us.2 = fadd double %.525.us.us.1, %.524.us.us.2
  store double %.525.us.us.2, ptr %sunkaddr128, align 8
  %.532.us.us.2 = fadd double %.532.us.us.1, %.492.us.us.2
  store double %.532.us.us.2, ptr %sunkaddr129, align 8
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
  store double %.503.us.us.3, ptr %sunkaddr126, align 8
  %.512.us.us.3 = load double, ptr %scevgep70, align 8
  %.516.us.us.3 = fmul double %.512.us.us.3, %.512.us.us.3
  %.517.us.us.3 = fadd double %.517.us.us.2, %.516.us.us.3
  store double %.517.us.us.3, ptr %sunkaddr127, align 8
  %.524.us.us.3 = tail call double @llvm.fabs.f64(double %.492.us.us.3)
  %.525.us.us.3 = fadd double %.525.us.us.2, %.524.us.us.3
  store double %.525.us.us.3, ptr %sunkaddr128, align 8
  %.532.us.us.3 = fadd double %.532.us.us.2, %.492.us.us.3
  store double %.532.us.us.3, ptr %sunkaddr129, align 8
  %niter20.ncmp.3 = icmp eq i64 %unroll_iter19, %.455.us.us.3
  br i1 %niter20.ncmp.3, label %B816.us.us.loopexit.unr-lcssa, label %B540.us.us

B272.us.us:
  %arg.out.promoted.us.us258 = phi double [ %arg.out.promoted.us.us257.7, %B420.us.us.7 ], [ %arg.out.promoted.us.us, %B272.us.us.preheader ]
  %.303140.us.us = phi double [ %.303139.us.us.7, %B420.us.us.7 ], [ %arg.out.promoted.us.us, %B272.us.us.preheader ]
  %.264134136.us.us = phi i64 [ %.271.us.us.7, %B420.us.us.7 ], [ 0, %B272.us.us.preheader ]
  %27 = shl i64 %.264134136.us.us, 3
  %scevgep25 = getelementptr i8, ptr %scevgep23, i64 %27
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
  br i1 %13, label %B270.B422_crit_edge.us.us, label %B272.us.us.epil.preheader

B272.us.us.epil.preheader:
  %arg.out.promoted.us.us258.epil.init = phi double [ %arg.out.promoted.us.us, %B38.endif.us.us ], [ %arg.out.promoted.us.us257.7, %B270.B422_crit_edge.us.us.unr-lcssa ]
  %.303140.us.us.epil.init = phi double [ %arg.out.promoted.us.us, %B38.endif.us.us ], [ %.303139.us.us.7, %B270.B422_crit_edge.us.us.unr-lcssa ]
  %.264134136.us.us.epil.init = phi i64 [ 0, %B38.endif.us.us ], [ %unroll_iter13, %B270.B422_crit_edge.us.us.unr-lcssa ]
  %28 = add i64 %.264134136.us.us.epil.init, %.156.us.us
  %29 = shl i64 %28, 3
  %scevgep41 = getelementptr i8, ptr %arg.rows.pn, i64 %29
  br label %B272.us.us.epil

B272.us.us.epil:
  %arg.out.promoted.us.us258.epil = phi double [ %arg.out.promoted.us.us258.epil.init, %B272.us.us.epil.preheader ], [ %arg.out.promoted.us.us257.epil, %B420.us.us.epil ]
  %.303140.us.us.epil = phi double [ %.303140.us.us.epil.init, %B272.us.us.epil.preheader ], [ %.303139.us.us.epil, %B420.us.us.epil ]
  %epil.iter9 = phi i64 [ 0, %B272.us.us.epil.preheader ], [ %epil.iter9.next, %B420.us.us.epil ]
  %30 = shl nuw nsw i64 %epil.iter9, 3
  %scevgep42 = getelementptr i8, ptr %scevgep41, i64 %30
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
  br i1 %epil.iter9.cmp.not, label %B270.B422_crit_edge.us.us, label %B272.us.us.epil, !llvm.loop !7

B270.B422_crit_edge.us.us:
  %arg.out.promoted.us.us257.lcssa = phi double [ %arg.out.promoted.us.us257.7, %B270.B422_crit_edge.us.us.unr-lcssa ], [ %arg.out.promoted.us.us257.epil, %B420.us.us.epil ]
  %.118.us.us = add nuw nsw i64 %.111153167.us.us, 1
  %.342.us.us = icmp slt i64 %.118.us.us, %arg.count
  br i1 %.342.us.us, label %B440.us.us, label %B816.us.us

B440:
  %sunkaddr139 = getelementptr i8, ptr %lsr.iv106, i64 %sunkaddr138
  %.347 = load double, ptr %sunkaddr139, align 8
  %.350 = load double, ptr %lsr.iv106, align 8
  %.353 = fcmp ogt double %.347, %.350
  br i1 %.353, label %B476.endif, label %B816

B816:
  %31 = add nsw i64 %lsr.iv104, -2
  %.342.1 = icmp slt i64 %31, %arg.count
  br i1 %.342.1, label %B440.1, label %B816.1

B440.1:
  %scevgep120 = getelementptr i8, ptr %lsr.iv106, i64 %7
  %.347.1 = load double, ptr %scevgep120, align 8
  %sunkaddr141 = getelementptr i8, ptr %lsr.iv106, i64 %sunkaddr138
  %.350.1 = load double, ptr %sunkaddr141, align 8
  %.353.1 = fcmp ogt double %.347.1, %.350.1
  br i1 %.353.1, label %B476.endif.1, label %B816.1

B476.endif.1:
  %.357.1 = load double, ptr %sunkaddr152, align 8
  %.358.1 = fadd double %.357.1, 1.000000e+00
  store double %.358.1, ptr %sunkaddr152, align 8
  br label %B816.1

B816.1:
  %.342.2.not = icmp sgt i64 %lsr.iv104, %arg.count
  br i1 %.342.2.not, label %B816.2, label %B440.2

B440.2:
  %scevgep119 = getelementptr i8, ptr %lsr.iv106, i64 %7
  %scevgep118 = getelementptr i8, ptr %lsr.iv106, i64 %6
  %.347.2 = load double, ptr %scevgep118, align 8
  %.350.2 = load double, ptr %scevgep119, align 8
  %.353.2 = fcmp ogt double %.347.2, %.350.2
  br i1 %.353.2, label %B476.endif.2, label %B816.2

B476.endif.2:
  %.357.2 = load double, ptr %sunkaddr152, align 8
  %.358.2 = fadd double %.357.2, 1.000000e+00
  store double %.358.2, ptr %sunkaddr152, align 8
  br label %B816.2

B816.2:
  %.342.3 = icmp slt i64 %lsr.iv104, %arg.count
  br i1 %.342.3, label %B440.3, label %B816.3

B440.3:
  %scevgep117 = getelementptr i8, ptr %lsr.iv106, i64 %6
  %scevgep116 = getelementptr i8, ptr %lsr.iv106, i64 %5
  %.347.3 = load double, ptr %scevgep116, align 8
  %.350.3 = load double, ptr %scevgep117, align 8
  %.353.3 = fcmp ogt double %.347.3, %.350.3
  br i1 %.353.3, label %B476.endif.3, label %B816.3

B476.endif.3:
  %.357.3 = load double, ptr %sunkaddr152, align 8
  %.358.3 = fadd double %.357.3, 1.000000e+00
  store double %.358.3, ptr %sunkaddr152, align 8
  br label %B816.3

B816.3:
  %32 = or disjoint i64 %lsr.iv104, 1
  %.342.4 = icmp slt i64 %32, %arg.count
  br i1 %.342.4, label %B440.4, label %B816.4

B440.4:
  %scevgep115 = getelementptr i8, ptr %lsr.iv106, i64 %5
  %scevgep114 = getelementptr i8, ptr %lsr.iv106, i64 %4
  %.347.4 = load double, ptr %scevgep114, align 8
  %.350.4 = load double, ptr %scevgep115, align 8
  %.353.4 = fcmp ogt double %.347.4, %.350.4
  br i1 %.353.4, label %B476.endif.4, label %B816.4

B476.endif.4:
  %.357.4 = load double, ptr %sunkaddr152, align 8
  %.358.4 = fadd double %.357.4, 1.000000e+00
  store double %.358.4, ptr %sunkaddr152, align 8
  br label %B816.4

B816.4:
  %33 = or disjoint i64 %lsr.iv104, 2
  %.342.5 = icmp slt i64 %33, %arg.count
  br i1 %.342.5, label %B440.5, label %B816.5

B440.5:
  %scevgep113 = getelementptr i8, ptr %lsr.iv106, i64 %4
  %scevgep112 = getelementptr i8, ptr %lsr.iv106, i64 %3
  %.347.5 = load double, ptr %scevgep112, align 8
  %.350.5 = load double, ptr %scevgep113, align 8
  %.353.5 = fcmp ogt double %.347.5, %.350.5
  br i1 %.353.5, label %B476.endif.5, label %B816.5

B476.endif.5:
  %.357.5 = load double, ptr %sunkaddr152, align 8
  %.358.5 = fadd double %.357.5, 1.000000e+00
  store double %.358.5, ptr %sunkaddr152, align 8
  br label %B816.5

B816.5:
  %34 = or disjoint i64 %lsr.iv104, 3
  %.342.6 = icmp slt i64 %34, %arg.count
  br i1 %.342.6, label %B440.6, label %B816.6

B440.6:
  %scevgep111 = getelementptr i8, ptr %lsr.iv106, i64 %3
  %scevgep109 = getelementptr i8, ptr %lsr.iv106, i64 %1
  %.347.6 = load double, ptr %scevgep109, align 8
  %.350.6 = load double, ptr %scevgep111, align 8
  %.353.6 = fcmp ogt double %.347.6, %.350.6
  br i1 %.353.6, label %B476.endif.6, label %B816.6

B476.endif.6:
  %.357.6 = load double, ptr %sunkaddr152, align 8
  %.358.6 = fadd double %.357.6, 1.000000e+00
  store double %.358.6, ptr %sunkaddr152, align 8
  br label %B816.6

B816.6:
  %35 = add nuw nsw i64 %lsr.iv104, 4
  %.342.7 = icmp slt i64 %35, %arg.count
  br i1 %.342.7, label %B440.7, label %B816.7

B440.7:
  %scevgep108 = getelementptr i8, ptr %lsr.iv106, i64 %1
  %scevgep110 = getelementptr i8, ptr %lsr.iv106, i64 %2
  %.347.7 = load double, ptr %scevgep110, align 8
  %.350.7 = load double, ptr %scevgep108, align 8
  %.353.7 = fcmp ogt double %.347.7, %.350.7
  br i1 %.353.7, label %B476.endif.7, label %B816.7

B476.endif.7:
  %.357.7 = load double, ptr %sunkaddr152, align 8
  %.358.7 = fadd double %.357.7, 1.000000e+00
  store double %.358.7, ptr %sunkaddr152, align 8
  br label %B816.7

B816.7:
  %lsr.iv.next105 = add nuw nsw i64 %lsr.iv104, 8
  %scevgep107 = getelementptr i8, ptr %lsr.iv106, i64 %2
  %36 = sub nsw i64 %lsr.iv.next105, %8
  %niter.ncmp.7 = icmp eq i64 %36, 4
  br i1 %niter.ncmp.7, label %B820.loopexit6.unr-lcssa, label %B38.endif

B820.loopexit6.unr-lcssa:
  %lcmp.mod.not = icmp eq i64 %xtraiter, 0
  br i1 %lcmp.mod.not, label %B820, label %B38.endif.epil.preheader

B38.endif.epil.preheader:
  %.pre-phi = phi i64 [ %.pre, %B38.endif.preheader.B38.endif.epil.preheader_crit_edge ], [ %sunkaddr138, %B820.loopexit6.unr-lcssa ]
  %.111153167.epil.init = phi i64 [ 0, %B38.endif.preheader.B38.endif.epil.preheader_crit_edge ], [ %8, %B820.loopexit6.unr-lcssa ]
  %37 = shl i64 %.111153167.epil.init, 3
  %38 = or disjoint i64 %37, 8
  %39 = mul i64 %38, %arg.width
  %factor.op.mul = mul i64 %arg.width, %.111153167.epil.init
  %.reass = shl i64 %factor.op.mul, 3
  %sunkaddr151 = getelementptr i8, ptr %arg.out, i64 8
  br label %B38.endif.epil

B38.endif.epil:
  %lsr.iv102 = phi i64 [ %lsr.iv.next103, %B816.epil ], [ %xtraiter, %B38.endif.epil.preheader ]
  %lsr.iv100.in = phi i64 [ %lsr.iv100, %B816.epil ], [ %.111153167.epil.init, %B38.endif.epil.preheader ]
  %lsr.iv96 = phi ptr [ %scevgep97, %B816.epil ], [ %arg.rows, %B38.endif.epil.preheader ]
  %lsr.iv100 = add nuw i64 %lsr.iv100.in, 1
  %.342.epil = icmp slt i64 %lsr.iv100, %arg.count
  br i1 %.342.epil, label %B440.epil, label %B816.epil

B440.epil:
  %scevgep99 = getelementptr i8, ptr %lsr.iv96, i64 %39
  %.347.epil = load double, ptr %scevgep99, align 8
  %sunkaddr150 = getelementptr i8, ptr %lsr.iv96, i64 %.reass
  %.350.epil = load double, ptr %sunkaddr150, align 8
  %.353.epil = fcmp ogt double %.347.epil, %.350.epil
  br i1 %.353.epil, label %B476.endif.epil, label %B816.epil

B476.endif.epil:
  %.357.epil = load double, ptr %sunkaddr151, align 8
  %.358.epil = fadd double %.357.epil, 1.000000e+00
  store double %.358.epil, ptr %sunkaddr151, align 8
  br label %B816.epil

B816.epil:
  %scevgep97 = getelementptr i8, ptr %lsr.iv96, i64 %.pre-phi
  %lsr.iv.next103 = add nsw i64 %lsr.iv102, -1
  %epil.iter.cmp.not = icmp eq i64 %lsr.iv.next103, 0
  br i1 %epil.iter.cmp.not, label %B820, label %B38.endif.epil, !llvm.loop !8

B820:
  store ptr null, ptr %retptr, align 8
  ret i32 0

B38.endif:
  %lsr.iv106 = phi ptr [ %scevgep107, %B816.7 ], [ %arg.rows, %B38.endif.preheader.new ]
  %lsr.iv104 = phi i64 [ %lsr.iv.next105, %B816.7 ], [ 4, %B38.endif.preheader.new ]
  %40 = add nsw i64 %lsr.iv104, -3
  %.342 = icmp slt i64 %40, %arg.count
  br i1 %.342, label %B440, label %B816

B476.endif:
  %.357 = load double, ptr %sunkaddr152, align 8
  %.358 = fadd double %.357, 1.000000e+00
  store double %.358, ptr %sunkaddr152, align 8
  br label %B816
}


define ptr @totals(ptr readonly %.1, i64 %.2, ptr readonly %.3, i64 %.4, i64 %.5, ptr %.6) local_unnamed_addr #1 {
entry:
  %.8 = alloca ptr, align 8
  store ptr null, ptr %.8, align 8
  %.12 = call i32 @_ZN18biped_adrc_kernels6totalsB4v125B56c8tJTIeFIjxB2IKSgI4CrvQCk0Z4yRYcWsBAg6cJqBrMeIZJFEGM0QQAE10float64_2ax8int64_2axx10float64_2a(ptr nonnull %.8, ptr nonnull poison, ptr %.1, i64 %.2, ptr %.3, i64 %.4, i64 %.5, ptr %.6) #2
  %.22 = load ptr, ptr %.8, align 8
  ret ptr %.22
}


declare void @llvm.trap() #4

attributes #0 = { nounwind }
attributes #1 = { nounwind }
attributes #2 = { nounwind }
attributes #3 = { nounwind }
attributes #4 = { nounwind }

!0 = distinct !{!0, !1}
!1 = !{!"llvm.loop.unroll.disable"}
!2 = !{!"branch_weights", i32 49, i32 1}
!3 = !{!"branch_weights", i32 1, i32 49, i32 49}
!4 = distinct !{!4, !5}
!5 = !{!"llvm.loop.peeled.count", i32 1}
!6 = distinct !{!6, !1}
!7 = distinct !{!7, !1}
!8 = distinct !{!8, !1}
