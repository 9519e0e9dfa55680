/* hlr.cpp: OpenCASCADE's hidden-line removal, both algorithms.
 *
 *     bench_hlr MESH.off poly|exact LINES.txt DRAWING.svg       prints the seconds of the algorithm alone
 *
 * The mesh is seen along -z. It becomes a shell of plane faces with common edges. An edge that ought to be drawn
 * (borders, silhouettes, creases of more than 30 degrees) is sharp, and all others are smooth. So the sharp visible
 * lines are the drawing. Poly is HLRBRep_PolyAlgo, exact is HLRBRep_Algo. */
#include <BRepAdaptor_Curve.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Builder.hxx>
#include <HLRAlgo_Projector.hxx>
#include <HLRBRep_Algo.hxx>
#include <HLRBRep_HLRToShape.hxx>
#include <HLRBRep_PolyAlgo.hxx>
#include <HLRBRep_PolyHLRToShape.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <gp_Pln.hxx>
#include <map>
#include <utility>
#include <vector>

struct side {
    int triangle;
    bool ascends;
};

static double seconds() {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

static gp_Vec normal_of(const std::vector<gp_Pnt> &p, const int *t) {
    gp_Vec n = gp_Vec(p[t[0]], p[t[1]]).Crossed(gp_Vec(p[t[0]], p[t[2]]));
    return n.Normalized();
}

static TopoDS_Shell shell_of(const char *path) {
    FILE *file = fopen(path, "r");
    int points, triangles;
    if (!file || fscanf(file, "OFF %d %d %*d", &points, &triangles) != 2) exit(1);
    std::vector<gp_Pnt> p(points);
    std::vector<int> t(3 * triangles);
    for (gp_Pnt &q : p) {
        double x[3];
        if (fscanf(file, "%lf %lf %lf", x, x + 1, x + 2) != 3) exit(1);
        q = gp_Pnt(x[0], x[1], x[2]);
    }
    for (int i = 0; i < triangles; i++)
        if (fscanf(file, "%*d %d %d %d", &t[3 * i], &t[3 * i + 1], &t[3 * i + 2]) != 3) exit(1);
    fclose(file);
    BRep_Builder builder;
    std::vector<TopoDS_Vertex> vertices(points);
    for (int i = 0; i < points; i++) builder.MakeVertex(vertices[i], p[i], 1e-7);
    std::map<std::pair<int, int>, std::pair<TopoDS_Edge, std::vector<side>>> edges;
    std::vector<TopoDS_Face> faces(triangles);
    TopoDS_Shell shell;
    builder.MakeShell(shell);
    for (int i = 0; i < triangles; i++) {
        BRepBuilderAPI_MakeWire wire;
        for (int k = 0; k < 3; k++) {
            const int a = t[3 * i + k], b = t[3 * i + (k + 1) % 3];
            auto &edge = edges[{std::min(a, b), std::max(a, b)}];
            if (edge.first.IsNull())
                edge.first = BRepBuilderAPI_MakeEdge(vertices[std::min(a, b)], vertices[std::max(a, b)]);
            edge.second.push_back({i, a < b});
            wire.Add(a < b ? edge.first : TopoDS::Edge(edge.first.Reversed()));
        }
        faces[i] = BRepBuilderAPI_MakeFace(gp_Pln(p[t[3 * i]], gp_Dir(normal_of(p, &t[3 * i]))), wire.Wire());
        builder.Add(shell, faces[i]);
    }
    for (auto &entry : edges) {
        const std::vector<side> &s = entry.second.second;
        if (s.size() != 2) continue;
        const double sign = s[0].ascends == s[1].ascends ? -1 : 1;
        const gp_Vec n = normal_of(p, &t[3 * s[0].triangle]), m = normal_of(p, &t[3 * s[1].triangle]);
        const bool sharp = (n.Z() > 0) != (sign * m.Z() > 0) || sign * n.Dot(m) <= std::cos(30 * M_PI / 180);
        builder.Continuity(entry.second.first, faces[s[0].triangle], faces[s[1].triangle],
                           sharp ? GeomAbs_C0 : GeomAbs_C2);
    }
    return shell;
}

int main(int argc, char **argv) {
    if (argc != 5) return 2;
    const TopoDS_Shell shell = shell_of(argv[1]);
    const HLRAlgo_Projector projector(gp_Ax2(gp::Origin(), gp::DZ(), gp::DX()));
    TopoDS_Shape lines;
    double start;
    if (!strcmp(argv[2], "poly")) {
        BRepMesh_IncrementalMesh mesh(shell, 1);
        start = seconds();
        Handle(HLRBRep_PolyAlgo) algo = new HLRBRep_PolyAlgo();
        algo->Load(shell);
        algo->Projector(projector);
        algo->Update();
        HLRBRep_PolyHLRToShape out;
        out.Update(algo);
        lines = out.VCompound();
    } else {
        start = seconds();
        Handle(HLRBRep_Algo) algo = new HLRBRep_Algo();
        algo->Add(shell);
        algo->Projector(projector);
        algo->Update();
        algo->Hide();
        HLRBRep_HLRToShape out(algo);
        lines = out.VCompound();
    }
    printf("%.4f\n", seconds() - start);
    if (!lines.IsNull()) BRepLib::BuildCurves3d(lines);
    FILE *text = fopen(argv[3], "w"), *svg = fopen(argv[4], "w");
    if (!text || !svg) return 1;
    fprintf(svg, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1000 1000\">\n<path fill=\"none\" "
                 "stroke=\"#000\" d=\"");
    for (TopExp_Explorer e(lines, TopAbs_EDGE); !lines.IsNull() && e.More(); e.Next()) {
        const BRepAdaptor_Curve curve(TopoDS::Edge(e.Current()));
        const gp_Pnt a = curve.Value(curve.FirstParameter()), b = curve.Value(curve.LastParameter());
        fprintf(text, "%.9g %.9g %.9g %.9g\n", a.X(), a.Y(), b.X(), b.Y());
        fprintf(svg, "M%.2f %.2fL%.2f %.2f", 500 + a.X(), 500 - a.Y(), 500 + b.X(), 500 - b.Y());
    }
    fprintf(svg, "\"/>\n</svg>\n");
    return fclose(text) || fclose(svg);
}
