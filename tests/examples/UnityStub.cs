// SPDX-License-Identifier: MIT
// As much of UnityEngine as the scripts of examples/unity use, and a console that plays Unity: it
// calls what Unity calls, frame after frame, on its main thread.
using System;
using System.Reflection;
using System.Threading;

namespace UnityEngine
{
    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
    }

    public struct Quaternion
    {
        public float x, y, z, w;
    }

    public class Transform
    {
        public Vector3 position;
        public Quaternion rotation;
    }

    public class MonoBehaviour
    {
        public Transform transform = new Transform();
    }
}

public static class Console1
{
    static void Call(object script, string method)
    {
        script.GetType().GetMethod(method, BindingFlags.Instance | BindingFlags.NonPublic).Invoke(script, null);
    }

    static string Told(string what, SplashEvent e, int main)
    {
        bool here = Thread.CurrentThread.ManagedThreadId == main;
        return string.Format(System.Globalization.CultureInfo.InvariantCulture,
            "{0} body {1} speed {2:0.00} radius {3:0.000} at {4:0.00} {5:0.00} {6:0.00} in {7:0.000} s {8} thread",
            what, e.Body, e.Speed, e.Radius, e.Place.x, e.Place.y, e.Place.z, e.Delay, here ? "main" : "another");
    }

    public static void Main(string[] arguments)
    {
        int port = int.Parse(arguments[0]);
        int main = Thread.CurrentThread.ManagedThreadId;
        var events = new SplashEvents { Port = port };
        var body = new SplashBody { Port = port };
        body.transform.position = new UnityEngine.Vector3(0.25f, 1.5f, -0.75f);
        body.transform.rotation = new UnityEngine.Quaternion { x = 0.1f, y = 0.7f, z = -0.1f, w = 0.7f };
        events.Impact += e => Console.WriteLine(Told("impact", e, main));
        events.Bubble += e => Console.WriteLine(Told("bubble", e, main));
        events.Cavity += e => Console.WriteLine(Told("cavity", e, main));
        Call(events, "OnEnable");
        Call(body, "OnEnable");
        for (int frame = 0; frame < 60; ++frame)
        {
            Call(events, "Update");
            Call(body, "LateUpdate");
            Thread.Sleep(16);
        }
        Call(events, "OnDisable");
        Call(body, "OnDisable");
        Console.WriteLine("over");
    }
}
